"""A finished run that several test files continue."""

import shutil
from pathlib import Path

import pytest
from corridor_runs import IN_CORRIDOR, run


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """A small finished run."""
    return run(tmp_path_factory.mktemp("runs") / "run", *IN_CORRIDOR, "--budget", "60")


@pytest.fixture
def copy(finished, tmp_path):
    """A copy of it, to be damaged."""
    return Path(shutil.copytree(finished, tmp_path / "copy"))
