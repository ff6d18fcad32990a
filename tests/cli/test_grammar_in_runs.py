"""Runs keep their whole grammar, and begin only from trees that belong to it."""

import pytest

from grammarbt.bt import parse
from grammarbt.cli import main
from grammarbt.run.journal import read_journal

MAIN = '%declare ACTION\n%import .parts (guarded)\nstart: "?" "(" guarded ACTION ")"\n'
PARTS = '%declare ACTION CONDITION\nguarded: "→" "(" CONDITION ACTION ")"\n'
RUN = ("run", "--searcher", "random", "--domain", "marine", "--validation", "20", "--seed", "1", "--quiet")


@pytest.fixture
def grammar(tmp_path):
    """A grammar and the neighbour that it imports from."""
    (tmp_path / "parts.grammar").write_text(PARTS, encoding="utf-8")
    path = tmp_path / "own.grammar"
    path.write_text(MAIN, encoding="utf-8")
    return path


def test_a_run_goes_on_after_the_files_of_its_grammar_are_gone(grammar, tmp_path):
    run = (*RUN, "--grammar", str(grammar))
    assert main([*run, "--budget", "60", "--out", str(tmp_path / "whole")]) == 0
    assert main([*run, "--budget", "30", "--out", str(tmp_path / "part")]) == 0
    for path in tmp_path.glob("*.grammar"):
        path.unlink()
    assert main(["resume", str(tmp_path / "part"), "--budget", "60", "--quiet"]) == 0
    whole, part = ((tmp_path / name / "journal.jsonl").read_bytes() for name in ("whole", "part"))
    assert part == whole


def test_a_run_goes_on_with_the_grammar_it_began_with_though_the_file_changed(grammar, tmp_path):
    folder = tmp_path / "run"
    assert main([*RUN, "--grammar", str(grammar), "--budget", "30", "--out", str(folder)]) == 0
    grammar.write_text('%declare ACTION\nstart: "→" "(" ACTION ")"\n', encoding="utf-8")
    assert main(["resume", str(folder), "--budget", "60", "--quiet"]) == 0
    trees = {parse(event["tree"]) for event in read_journal(folder / "journal.jsonl") if event["event"] == "trial"}
    assert {len(tree.children) for tree in trees} == {2}


def test_a_start_tree_outside_of_the_language_is_one_line_that_says_where_it_leaves(grammar, tmp_path, capsys):
    tree = "?( →( (mine found) [disarm] ) →( [report] ) )"
    out = tmp_path / "run"
    assert main([*RUN, "--grammar", str(grammar), "--budget", "30", "--start", tree, "--out", str(out)]) == 2
    error, hint = capsys.readouterr().err.splitlines()
    assert error.startswith("error: the start tree cannot be used: the tree leaves the language at '→', node 5, after")
    assert hint.startswith("hint: closest: ")
    assert not out.exists()


def test_a_start_tree_of_the_language_is_the_first_trial(grammar, tmp_path):
    tree = "?( →( (mine found) [disarm] ) [report] )"
    out = tmp_path / "run"
    assert main([*RUN, "--grammar", str(grammar), "--budget", "30", "--start", tree, "--out", str(out)]) == 0
    assert next(event for event in read_journal(out / "journal.jsonl") if event["event"] == "trial")["tree"] == tree
