"""The page on trees: every command on it is run, and prints what the page says."""

import re
import shlex
from pathlib import Path

import pytest

from grammarbt.bt import parse
from grammarbt.bt.formats import indented
from grammarbt.cli import main
from grammarbt.plugins.builtin_formats import FORMATS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/how-to/trees.md").read_text(encoding="utf-8")


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A folder like the project's, to write into."""
    (tmp_path / "docs").symlink_to(ROOT / "docs")
    monkeypatch.chdir(tmp_path)


def test_every_command_prints_what_the_page_says(project, capsys):
    blocks = re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    ran, code = set(), 0
    for line, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", "".join(blocks), re.MULTILINE):
        if line == "echo $?":
            assert f"{code}\n" == expected
            continue
        program, *arguments = shlex.split(line)
        code = main(arguments)
        assert program == "grammarbt"
        assert capsys.readouterr().out == expected
        ran.add(arguments[1])
    assert ran == {"show", "convert", "simplify", "diff", "check"}


def test_the_table_of_formats_is_complete_and_true():
    rows = re.findall(r"^\| (`.*`) +\| (.*?) \| (yes|no) \|", PAGE, re.MULTILINE)
    named = {name: (ending, read) for names, ending, read in rows for name in re.findall(r"`(\w+)`", names)}
    assert sorted(named) == sorted(spec.name for spec in FORMATS)
    for spec in FORMATS:
        ending, read = named[spec.name]
        assert spec.suffixes[0] in ending or ending == "as named"
        assert (read == "yes") == (spec.importer is not None)


def test_the_indented_tree_on_the_page_is_read():
    (text,) = re.findall(r"```tree\n(.*?)```", PAGE, re.DOTALL)
    assert indented.loads(text) == parse("?( →( [go to cup] [grasp] ) →( !(at cup) [go to door] ) )")
