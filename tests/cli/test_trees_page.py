"""The page on trees lists every format, and its examples are read; what it tells to type is typed in tests/docs."""

import re
from pathlib import Path

from grammarbt.bt import parse
from grammarbt.bt.formats import indented
from grammarbt.plugins.builtin_formats import FORMATS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/how-to/trees.md").read_text(encoding="utf-8")


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
