"""Runs in the corridor of the examples: short ones, and what they leave."""

from pathlib import Path

from grammarbt.cli import main

CORRIDOR_FILE = Path(__file__).parents[2] / "docs" / "examples" / "corridor.py"
CORRIDOR = f"{CORRIDOR_FILE}:Corridor"
SMALL = ("--searcher", "random", "--validation", "20", "--seed", "3", "--batch", "7")
IN_CORRIDOR = ("--domain", CORRIDOR, *SMALL)


def grammarbt(*arguments):
    assert main([*arguments, "--quiet"]) == 0


def run(folder, *arguments):
    grammarbt("run", *arguments, "--out", str(folder))
    return folder


def journal(folder):
    return (folder / "journal.jsonl").read_bytes()
