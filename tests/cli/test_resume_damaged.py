"""Runs that were cut, damaged, or changed since: resumed to the same bytes, or refused with the place."""

import contextlib
import io
import shutil
import tempfile
from pathlib import Path

from corridor_runs import grammarbt, journal
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.cli import main
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import read_journal


def test_a_journal_cut_anywhere_is_completed_to_the_same_bytes(finished, copy):
    whole = journal(finished)
    for size in range(0, len(whole), len(whole) // 40):
        (copy / "journal.jsonl").write_bytes(whole[:size])
        grammarbt("resume", str(copy))
        assert journal(copy) == whole


def rewrite_resolved(folder, change):
    resolved = dict(RunFolder(folder).read_resolved())
    change(resolved)
    RunFolder(folder).save_resolved(resolved)


def test_other_versions_are_one_line_of_warning(copy, capsys):
    rewrite_resolved(copy, lambda resolved: resolved["versions"].update(numpy="0.1"))
    grammarbt("resume", str(copy))
    (line,) = capsys.readouterr().err.splitlines()
    assert "numpy 0.1 then" in line


def test_a_searcher_that_proposes_otherwise_is_an_error_naming_the_trial(copy, capsys):
    before = journal(copy)
    rewrite_resolved(copy, lambda resolved: (resolved["spec"].update(seed=4), resolved.update(seed=4)))
    assert main(["resume", str(copy), "--quiet"]) == 2
    first = read_journal(copy / "journal.jsonl")[0]["tree"]
    assert f"line 1: trial 1 was {first} on the scenarios 0 to 1" in capsys.readouterr().err
    assert journal(copy) == before


def test_a_changed_grammar_is_named(copy, capsys):
    rewrite_resolved(copy, lambda resolved: resolved["grammar"].update(fingerprint="other"))
    assert main(["resume", str(copy), "--quiet"]) == 2
    assert "the grammar of" in capsys.readouterr().err


def damage(data, content):
    """The content with bytes changed, or lines lost, doubled or moved."""
    lines = content.splitlines(keepends=True)
    one, two = (data.draw(st.integers(0, len(lines) - 1)) for _ in range(2))
    kind = data.draw(st.sampled_from(["byte", "cut", "insert", "lose", "double", "swap"]))
    place = data.draw(st.integers(0, len(content) - 1))
    if kind == "byte":
        return content[:place] + data.draw(st.binary(min_size=1, max_size=1)) + content[place + 1 :]
    if kind == "cut":
        return content[:place]
    if kind == "insert":
        return content[:place] + data.draw(st.binary(max_size=5)) + content[place:]
    if kind == "lose":
        return b"".join(lines[:one] + lines[one + 1 :])
    if kind == "double":
        return b"".join([*lines[: one + 1], *lines[one:]])
    lines[one], lines[two] = lines[two], lines[one]
    return b"".join(lines)


@settings(max_examples=80, deadline=None)
@given(data=st.data())
def test_a_damaged_run_is_an_error_with_its_place_or_resumed_correctly(finished, data):
    name = data.draw(st.sampled_from(["journal.jsonl", "run.json", "spec.toml", "timing.jsonl", "best.tree"]))
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(shutil.copytree(finished, Path(scratch) / "run"))
        (folder / name).write_bytes(damage(data, (folder / name).read_bytes()))
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            code = main(["resume", str(folder), "--quiet"])
        if code == 0:
            assert journal(folder) == journal(finished)
        else:
            assert code == 2
            assert f"{folder}/{name}" in errors.getvalue().splitlines()[0]
