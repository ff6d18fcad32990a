"""Runs to report on."""

import shutil
from pathlib import Path

import pytest

from grammarbt.cli import main

ROOMS = Path(__file__).parent / "rooms.py"


@pytest.fixture(scope="session")
def made_run(tmp_path_factory):
    """A finished run, its domain in a file beside it."""
    place = tmp_path_factory.mktemp("rooms")
    domain = shutil.copy(ROOMS, place / "rooms.py")
    folder = place / "run"
    arguments = ["--domain", f"{domain}:Rooms", "--searcher", "random", "--budget", "300", "--validation", "60"]
    assert main(["run", *arguments, "--seed", "5", "--out", str(folder), "--quiet"]) == 0
    return folder


@pytest.fixture
def run(made_run, tmp_path):
    """A copy of the run, to change."""
    return shutil.copytree(made_run, tmp_path / "run")


@pytest.fixture
def rooms():
    return ROOMS
