"""The reference pages: every example is executed, and says what the page says."""

import re
from pathlib import Path

import numpy as np
import pytest

from grammarbt.bt import format_tree, parse
from grammarbt.bt.model import MAX_DEPTH
from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, count, expand, imports, leftmost, load_grammar, paths, reader
from grammarbt.grammar.check import check_source

ROOT = Path(__file__).parents[2]
GRAMMAR_PAGE = (ROOT / "docs/reference/grammar.md").read_text(encoding="utf-8")
DIAGNOSTICS_PAGE = (ROOT / "docs/reference/diagnostics.md").read_text(encoding="utf-8")

PLACE = (("place", ("home", "dock")),)
LEVEL = (("level", ("0.2", "0.4")),)
MINES = Group(
    "mines",
    (ActionType("disarm"), ActionType("report")),
    (ConditionType("mine found"), ConditionType("is armed")),
)
DOMAIN = Vocabulary(
    (
        MINES,
        Group(
            "moving",
            (ActionType("explore"), ActionType("go to", parameters=PLACE)),
            (ConditionType("battery below", parameters=LEVEL),),
        ),
    )
)
EXPLORE = Group("moving", (ActionType("explore"),))
DOMAINS = {
    "": Vocabulary((MINES, EXPLORE)),
    "empty": Vocabulary(()),
    "active": Vocabulary((EXPLORE,)),
    "crowd": Vocabulary(tuple(Group(f"g{n}", (ActionType(f"act {n}"),)) for n in range(1, 41))),
}


def examples(page):
    return re.findall(r"```grammar\n(.*?)```", page, re.DOTALL)


def sections(page):
    """Code, domain, grammar and rendering of each section about a code."""
    pattern = r"### (G\d{3}): .*?```grammar ?(\w*)\n(.*?)```\n\n```text\n(.*?)\n```"
    return re.findall(pattern, page, re.DOTALL)


@pytest.mark.parametrize("text", examples(GRAMMAR_PAGE))
def test_example_of_the_language_page_derives_trees(text):
    grammar, rng = bind(load_grammar(Source("example.grammar", text)), DOMAIN), np.random.default_rng(0)
    for _ in range(30):
        tree = grammar.tree(grammar.derive(grammar.sample(rng)))
        assert parse(format_tree(tree)) == tree


def test_language_page_has_an_example_for_every_heading_about_the_language():
    parts = GRAMMAR_PAGE.split("\n## ")[1:-1]
    assert [part.partition("\n")[0] for part in parts if "```grammar" not in part] == []


@pytest.mark.parametrize(("code", "domain", "text", "rendering"), sections(DIAGNOSTICS_PAGE))
def test_diagnostic_looks_as_on_its_page(tmp_path, code, domain, text, rendering):
    (tmp_path / "example.grammar").write_text(text, encoding="utf-8")
    report = check_source(Source("example.grammar", text, tmp_path), DOMAINS[domain])
    assert "\n\n".join(finding.render() for finding in report.findings) == rendering
    assert {finding.code for finding in report.findings} == {code}


def test_every_code_in_the_source_has_a_section_and_the_other_way_round():
    folder = ROOT / "src/grammarbt/grammar"
    used = {code for path in folder.glob("*.py") for code in re.findall(r'"(G\d{3})"', path.read_text())}
    assert used == {code for code, *_ in sections(DIAGNOSTICS_PAGE)}
    assert re.findall(r"### (G\d{3})", DIAGNOSTICS_PAGE) == sorted(used)


@pytest.mark.parametrize(("code", "domain", "text", "rendering"), sections(DIAGNOSTICS_PAGE))
def test_page_marks_warnings_as_such(code, domain, text, rendering):
    heading = next(line for line in DIAGNOSTICS_PAGE.splitlines() if line.startswith(f"### {code}"))
    assert heading.endswith("(warning)") == ("error[" not in rendering)
    assert text
    assert domain in DOMAINS


def test_limits_named_on_the_pages_are_those_of_the_source():
    numbers = [reader.MAX_CHARACTERS, reader.MAX_TOKENS, reader.MAX_NESTING, expand.MAX_PRODUCTIONS, expand.MAX_SYMBOLS]
    assert [n for n in numbers if f"{n:,}" not in GRAMMAR_PAGE or f"{n:,}" not in DIAGNOSTICS_PAGE] == []
    limits = [
        leftmost.MAX_UNFINISHED,
        leftmost.MAX_STEPS,
        paths.MAX_NODES,
        paths.MAX_STEPS,
        count.MAX_LISTED,
        MAX_DEPTH,
    ]
    assert [n for n in limits if f"{n:,}" not in GRAMMAR_PAGE] == []
    assert f"{imports.MAX_FILES} files, {imports.MAX_CHAIN} in a chain" in DIAGNOSTICS_PAGE
