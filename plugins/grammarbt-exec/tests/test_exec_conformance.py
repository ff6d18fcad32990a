import sys
from pathlib import Path

from grammarbt.testing import DomainConformance, DomainSubject

GREENHOUSE = Path(__file__).parents[3] / "docs" / "examples" / "exec" / "greenhouse.py"


class TestExec(DomainConformance):
    subject = DomainSubject("exec", {"command": f"{sys.executable} {GREENHOUSE}"})
