"""Write the playthroughs anew, after an example was changed on purpose: `python record_playthroughs.py`."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from grammarbt.testing import Playthroughs
from grammarbt_exec.domain import make_exec
from grammarbt_exec.parameters import ExecParameters

EXAMPLES = Path(__file__).parents[3] / "docs" / "examples" / "exec"


def greenhouse():
    return make_exec(ExecParameters(f"{sys.executable} -I -S {EXAMPLES / 'greenhouse.py'}"))


def rover():
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "rover"
        subprocess.run([shutil.which("cc"), "-O2", "-o", program, EXAMPLES / "rover.c"], check=True)
        return make_exec(ExecParameters(str(program)))


PLAYTHROUGHS = Playthroughs(
    Path(__file__).with_name("playthroughs"), {"greenhouse": (greenhouse, (0, 1)), "rover": (rover, (0, 1))}
)

if __name__ == "__main__":
    PLAYTHROUGHS.record()
