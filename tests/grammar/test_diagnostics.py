"""What findings say, where, and that they come together."""

import json

import pytest

from grammarbt.bt.vocabulary import Vocabulary
from grammarbt.grammar import GrammarFileError, Source, bind, load_grammar
from grammarbt.grammar.check import check_source
from grammarbt.grammar.diagnostics import MAX_FINDINGS
from grammarbt.grammar.reader import read
from grammarbt.grammar.syntax import Rule

BROKEN = """%declare ACTION
%unique WHATEVER in nowhere

start: "?" "(" ech each+ ")"
each: ACTIO
each: ACTION
"""


def test_several_errors_come_at_once_in_the_order_of_the_file():
    findings = check_source(Source("x.grammar", BROKEN)).findings
    assert [(finding.code, finding.span.line) for finding in findings] == [
        ("G201", 2),
        ("G211", 2),
        ("G201", 4),
        ("G209", 5),
        ("G202", 6),
    ]
    assert "did you mean 'each'?" in findings[2].render()


MISSPELT = """// what may go wrong in the text itself
%declare ACTION CONDITION
%limit nodes
start: "?" "(" each ech+ ")" )
each: ACTION @ 0 | CONDITION~3..2

other: "→" "("
   ACTION
   ")"
last: (ACTION
    | CONDITION ]
"""


def test_every_statement_has_its_own_syntax_errors_each_at_its_place():
    report = check_source(Source("x.grammar", MISSPELT))
    places = [(finding.code, finding.span.line, finding.span.text) for finding in report.findings]
    assert places == [
        ("G100", 3, "\n"),
        ("G100", 4, ")"),
        ("G103", 5, "0"),
        ("G104", 5, "CONDITION~3..2"),
        ("G100", 8, "ACTION"),
        ("G100", 11, "]"),
    ]
    assert "goes on in the next line only" in report.findings[4].help
    found = json.loads(json.dumps(report.as_json()))["diagnostics"]
    assert [(finding["line"], finding["column"]) for finding in found] == [
        (3, 13),
        (4, 30),
        (5, 16),
        (5, 20),
        (8, 4),
        (11, 17),
    ]


def test_a_very_wrong_file_gets_a_page_of_findings_and_no_more():
    text = "".join(f"r{number}: (\n" for number in range(500))
    assert len(check_source(Source("x.grammar", text)).findings) == MAX_FINDINGS


def test_statements_read_one_by_one_are_those_of_the_whole_file():
    source = Source(
        "x.grammar", 'a{x}: x\n  | (b\n  | c\n  )\n// b: c\n\n\t %limit depth 3\n b : "(x)" // c:\n | [d\n]\n'
    )
    items = read(source)
    assert [(type(item).__name__, item.span.line) for item in items] == [("Rule", 1), ("Limit", 7), ("Rule", 8)]
    assert [len(item.alternatives) for item in items if isinstance(item, Rule)] == [2, 2]


def test_the_exception_shows_every_finding(vocabulary):
    with pytest.raises(GrammarFileError) as error:
        bind(load_grammar(Source("x.grammar", BROKEN)), vocabulary((1, 1)))
    assert error.value.render().count("error[") == 5
    assert str(error.value).startswith("x.grammar:2:1: error[G201]")


def test_errors_come_before_warnings(vocabulary):
    text = '%declare ACTION CONDITION\nstart: "!" "(" ACTION ACTION ")"\n'
    report = check_source(Source("x.grammar", text), vocabulary((1, 1)))
    assert [finding.severity for finding in report.findings] == ["error", "warning"]
    assert (len(report.errors), len(report.warnings)) == (1, 1)


def test_json_gives_editors_the_exact_range():
    source = Source("x.grammar", 'start: "?" "(" each ")"\n')
    report = json.loads(json.dumps(check_source(source).as_json()))
    assert report["ok"] is False
    (finding,) = report["diagnostics"]
    place = {key: finding[key] for key in ("file", "line", "column", "end_line", "end_column")}
    assert place == {"file": "x.grammar", "line": 1, "column": 16, "end_line": 1, "end_column": 20}
    line = source.text.splitlines()[0]
    assert line[finding["column"] - 1 : finding["end_column"] - 1] == "each"


def test_caret_stays_below_the_word_after_a_tab():
    text = 'start:\t"?" "(" each ")"\n'
    lines = check_source(Source("x.grammar", text)).findings[0].render().splitlines()
    assert lines[2].index("each") == lines[3].index("^")


def test_a_carriage_return_is_not_shown():
    rendering = check_source(Source("x.grammar", 'start: "?" "(" each ")"\r\n')).findings[0].render()
    assert "\r" not in rendering


def test_a_finding_without_a_place_is_still_a_sentence():
    text = "%declare ACTION\nstart: ACTION\n"
    (finding,) = check_source(Source("x.grammar", text), Vocabulary(())).findings
    assert finding.render().startswith("grammar: error[G403]: the domain has no leaves\n")
    assert finding.as_json()["line"] is None
