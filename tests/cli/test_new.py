"""What `grammarbt new` writes installs, passes the conformance kit and learns something."""

import json
import os
import subprocess
import sys

import pytest
from installing import install

from grammarbt.cli import main


def call(*arguments, cwd, site):
    environment = {**os.environ, "PYTHONPATH": str(site)}
    command = [sys.executable, "-m", "grammarbt", *arguments]
    return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, timeout=120, check=False)


@pytest.fixture
def made(tmp_path, monkeypatch):
    def make(kind, name):
        monkeypatch.chdir(tmp_path)
        assert main(["new", kind, name]) == 0
        install(tmp_path / f"grammarbt-{name}", tmp_path / "site")
        return lambda *arguments: call(*arguments, cwd=tmp_path, site=tmp_path / "site")

    return make


def test_new_domain_passes_the_kit_and_is_learned(made):
    grammarbt = made("domain", "my-warehouse")
    checked = grammarbt("check", "domain", "my-warehouse", "--json")
    assert json.loads(checked.stdout)["ok"], checked.stdout
    run = (
        "run",
        "--domain",
        "my-warehouse",
        "--budget",
        "600",
        "--validation",
        "200",
        "--json",
    )
    result = json.loads(grammarbt(*run).stdout)
    assert result["value"] > 1.0
    assert result["reference"]["name"] == "manual"


def test_new_searcher_passes_the_kit_and_beats_its_own_first_trees(made):
    grammarbt = made("searcher", "my-climb")
    checked = grammarbt("check", "searcher", "my-climb", "--json")
    assert json.loads(checked.stdout)["ok"], checked.stdout
    run = ("run", "--domain", "marine", "--searcher", "my-climb", "--validation", "200", "--json")
    few, many = (json.loads(grammarbt(*run, "--budget", budget).stdout)["value"] for budget in ("60", "2000"))
    assert many > few


@pytest.mark.parametrize(("kind", "own"), [("domain", "delivers_parcels"), ("searcher", "solves_a_puzzle")])
def test_the_test_that_is_particular_to_a_new_plugin_passes(made, tmp_path, kind, own):
    made(kind, "my-own")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", own, "grammarbt-my-own/tests"]
    environment = {**os.environ, "PYTHONPATH": "site"}
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    assert "1 passed" in done.stdout, done.stdout


@pytest.mark.parametrize("name", ["My", "class", "a b", "-x", "../x", "ünder"])
def test_bad_name_is_refused_in_one_line(name, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "domain", "--", name]) == 2
    assert capsys.readouterr().err.startswith("error: ")
    assert not list(tmp_path.iterdir())


def test_folder_with_something_in_it_is_left_alone(tmp_path, capsys):
    (tmp_path / "mine").write_text("precious", encoding="utf-8")
    assert main(["new", "domain", "x", "--out", str(tmp_path)]) == 2
    assert "not empty" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
