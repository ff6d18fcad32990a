"""`grammarbt check` says what is wrong, and its exit code says whether."""

import importlib.util
import json
from pathlib import Path

from grammarbt.cli import main

WORLDS = Path(importlib.util.find_spec("grammarbt.testing.worlds").origin)
FAULTY = Path(__file__).parents[1] / "testing" / "faulty_domains.py"


def test_sound_domain_passes_with_exit_code_0(capsys):
    assert main(["check", "domain", f"{WORLDS}:Lamps"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == f"{len(lines) - 1} checks, none failed"


def test_fault_gives_exit_code_1_and_names_the_case(capsys):
    assert main(["check", "domain", f"{FAULTY}:OwnRandomness", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert not found["ok"]
    failed = {check["check"]: check for check in found["checks"] if check["status"] == "failed"}
    assert "same scenario same return" in failed
    assert "generator made from the scenario" in failed["same scenario same return"]["advice"]


def test_unknown_names_are_the_users_mistake(capsys):
    assert main(["check", "domain", "marin"]) == 2
    assert "did you mean 'marine'?" in capsys.readouterr().err
    assert main(["check", "searcher", "nothing.py:X"]) == 2
    assert "there is no file" in capsys.readouterr().err
