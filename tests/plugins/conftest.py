"""Throw-away distributions, installed the way pip leaves them, and the real command line that meets them."""

import os
import subprocess
import sys

import pytest


class Site:
    """A folder of installed distributions, in front of the environment's own."""

    def __init__(self, folder):
        self.folder = folder

    def install(self, name, source, entry=None, version="1.0"):
        """Installs the module `NAME_hooks`, announced as `entry`; without source the module is missing."""
        info = self.folder / f"{name}-{version}.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
        (info / "entry_points.txt").write_text(f"[grammarbt]\n{entry or name} = {name}_hooks\n")
        if source is not None:
            (self.folder / f"{name}_hooks.py").write_text(source)
        return info

    def python(self, *arguments, **environment):
        own = {name: value for name, value in os.environ.items() if not name.startswith("GRAMMARBT_")}
        return subprocess.run(
            [sys.executable, *arguments],
            env=own | {"PYTHONPATH": str(self.folder)} | environment,
            capture_output=True,
            text=True,
            check=False,
            cwd=self.folder,
        )

    def grammarbt(self, *arguments, **environment):
        return self.python("-m", "grammarbt", *arguments, **environment)


@pytest.fixture
def site(tmp_path):
    return Site(tmp_path)
