"""A compiled function on disk is used as long as no source of its package has changed, and no longer."""

import json
import os
import shutil
import subprocess
import sys
from importlib.resources import files

import pytest

ENTRY = """
import numba
from grammarbt.domain.sources import stamped
from team.deep.helper import FACTOR, helped

def run(number):
    return FACTOR * helped(number)

compiled = numba.njit(cache=True)(stamped(run))
"""
HELPER = """
import numba

FACTOR = 10

@numba.njit
def helped(number):
    return number + 1
"""
CHANGED = HELPER.replace("10", "11").replace("number + 1", "number + 2")
CALL = """
import json
from team.entry import compiled
result = compiled(1)
print(json.dumps([result, sum(compiled.stats.cache_hits.values()), sum(compiled.stats.cache_misses.values())]))
"""
MARINE = """
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters
domain = Marine(MarineParameters(roadmaps=1))
"""
PLATFORMER = """
from grammarbt_toys.platformer import Platformer
domain = Platformer()
"""
PLAY = """
import json
import numpy as np
from grammarbt.bt import compile_policy, parse
policy = compile_policy(parse(domain.references[0].tree), domain.vocabulary.index)
print(json.dumps(domain.simulate(policy, np.arange(8)).returns.tolist()))
"""


@pytest.fixture
def team(tmp_path):
    """The folder of a package whose compiled function calls another file."""
    (tmp_path / "team" / "deep").mkdir(parents=True)
    for module, text in {"__init__": "", "entry": ENTRY, "deep/__init__": "", "deep/helper": HELPER}.items():
        write(tmp_path, module, text)
    return tmp_path


def write(root, module, text):
    (root / "team" / f"{module}.py").write_text(text, encoding="utf-8")


def printed(root, code):
    """What the code prints in a process of its own that finds the packages of that folder first."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(root / "cache")}
    command = [sys.executable, "-B", "-c", code]  # -B: byte code is taken for fresh for a second after a change
    run = subprocess.run(command, cwd=root, env=environment, check=True, capture_output=True, text=True)
    return json.loads(run.stdout)


def test_a_change_in_an_imported_file_is_compiled_once_and_what_has_not_changed_is_not(team):
    assert printed(team, CALL) == [20, 0, 1]
    assert printed(team, CALL) == [20, 1, 0]
    write(team, "deep/helper", CHANGED)
    assert printed(team, CALL) == [33, 0, 1]
    assert printed(team, CALL) == [33, 1, 0]


def test_without_the_stamp_the_change_goes_unnoticed(team):
    write(team, "entry", ENTRY.replace("stamped(run)", "run"))
    assert printed(team, CALL) == [20, 0, 1]
    write(team, "deep/helper", CHANGED)
    assert printed(team, CALL) == [20, 1, 0]


@pytest.mark.parametrize(
    ("package", "chance", "simulator"),
    [
        ("grammarbt_marine", "kernel/chance.py", MARINE),
        ("grammarbt_toys", "chance.py", PLATFORMER),
    ],
    ids=["marine", "platformer"],
)
def test_a_simulator_from_which_chance_is_taken_plays_every_scenario_alike(tmp_path, package, chance, simulator):
    shutil.copytree(files(package), tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    code = simulator + PLAY
    assert len(set(printed(tmp_path, code))) > 1
    source = tmp_path / package / chance
    source.write_text(source.read_text(encoding="utf-8").replace("2.0**-53", "0.0"), encoding="utf-8")
    assert len(set(printed(tmp_path, code))) == 1
