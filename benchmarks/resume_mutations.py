"""Damage the files of a run folder in thousands of ways and resume: an error with its place, or the right journal.

python benchmarks/resume_mutations.py --mutations 10000
"""

from __future__ import annotations

import argparse
import contextlib
import io
import shutil
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

from grammarbt.cli import main as grammarbt
from grammarbt.cli.failures import SUCCESS, USER_MISTAKE

CORRIDOR = f"{Path(__file__).parents[1] / 'docs' / 'examples' / 'corridor.py'}:Corridor"
ARGUMENTS = ("--domain", CORRIDOR, "--searcher", "random", "--budget", "60", "--batch", "7", "--validation", "4")
FILES = ("journal.jsonl", "journal.jsonl", "snapshot.json", "run.json", "spec.toml", "timing.jsonl", "best.tree")
WRONG = "WRONG"
KINDS = ("byte", "bit", "cut", "insert", "zeros", "lose a line", "double a line", "swap lines", "empty", "remove")


def main() -> int:
    """Print what came of each kind of damage to each file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mutations", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    started, chance, found = time.monotonic(), np.random.default_rng(options.seed), Counter[tuple[str, str]]()
    with tempfile.TemporaryDirectory() as scratch:
        whole = _finished(Path(scratch))
        for number in range(options.mutations):
            name, kind = str(chance.choice(FILES)), str(chance.choice(KINDS))
            outcome, said = _outcome(whole, Path(scratch) / "copy", name, kind, chance)
            found[name, outcome] += 1
            if outcome == WRONG:
                print(f"mutation {number}: {kind} of {name} is wrong: {said}", flush=True)
    for (name, outcome), number in sorted(found.items()):
        print(f"{name:14}  {outcome:24}  {number:6,}")
    print(f"{sum(found.values()):,} mutations, {time.monotonic() - started:.0f} s")
    return any(outcome == WRONG for _, outcome in found)


def _finished(scratch: Path) -> Path:
    """A run with a snapshot, cut off somewhere after it, and the whole journal beside it."""
    spec, folder = scratch / "spec.toml", scratch / "run"
    spec.write_text("snapshot = 0.0\n", encoding="utf-8")
    _quietly("run", str(spec), *ARGUMENTS, "--out", str(folder))
    shutil.copy(folder / "journal.jsonl", scratch / "whole.jsonl")
    lines = (folder / "journal.jsonl").read_bytes().splitlines(keepends=True)
    (folder / "journal.jsonl").write_bytes(b"".join(lines[: len(lines) * 3 // 4]))
    return folder


def _outcome(run: Path, copy: Path, name: str, kind: str, chance: np.random.Generator) -> tuple[str, str]:
    """What resuming a damaged copy of a run came to, and what it said."""
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(run, copy)
    path = copy / name
    if kind == "remove":
        path.unlink()
    else:
        path.write_bytes(_damaged(path.read_bytes(), kind, chance))
    code, said = _quietly("resume", str(copy))
    if code == SUCCESS:
        same = (copy / "journal.jsonl").read_bytes() == (run.parent / "whole.jsonl").read_bytes()
        return "resumed correctly" if same else WRONG, said
    errors = [line for line in said.splitlines() if line.startswith("error: ")]
    placed = code == USER_MISTAKE and len(errors) == 1 and str(path) in errors[0]
    return "an error with its place" if placed else WRONG, said


def _damaged(content: bytes, kind: str, chance: np.random.Generator) -> bytes:
    place, lines = int(chance.integers(len(content))), content.splitlines(keepends=True)
    one, two = chance.integers(len(lines), size=2).tolist()
    if kind in ("byte", "bit"):
        change = 1 << int(chance.integers(8)) if kind == "bit" else int(chance.integers(1, 256))
        return content[:place] + bytes([content[place] ^ change]) + content[place + 1 :]
    if kind == "cut":
        return content[:place]
    if kind == "insert":
        return content[:place] + chance.bytes(int(chance.integers(1, 9))) + content[place:]
    if kind == "zeros":  # what some file systems leave after a power failure
        return content[:place] + bytes(len(content) - place)
    if kind == "lose a line":
        del lines[one]
    elif kind == "double a line":
        lines.insert(one, lines[one])
    elif kind == "swap lines":
        lines[one], lines[two] = lines[two], lines[one]
    return b"" if kind == "empty" else b"".join(lines)


def _quietly(*arguments: str) -> tuple[int, str]:
    """A command's exit code, and what it says on standard error."""
    errors = io.StringIO()
    with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
        return grammarbt([*arguments, "--quiet"]), errors.getvalue()


if __name__ == "__main__":
    sys.exit(main())
