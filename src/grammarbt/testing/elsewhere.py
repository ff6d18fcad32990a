"""Run as a module: simulate what standard input asks for, and print the returns as JSON."""

from __future__ import annotations

import json
import sys

import numpy as np

from grammarbt.bt import parse
from grammarbt.testing.subjects import DomainSubject


def main() -> None:
    """Read a task, write one list of returns per tree."""
    task = json.load(sys.stdin)
    subject = DomainSubject(task["domain"], task["settings"])
    scenarios = np.array(task["scenarios"], dtype=np.int64)
    returns = [subject.simulate(parse(tree), scenarios).returns for tree in task["trees"]]
    sys.stdout.write(json.dumps([np.asarray(each, dtype=np.float64).tolist() for each in returns]))


if __name__ == "__main__":
    main()
