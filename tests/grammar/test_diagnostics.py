"""What findings say, where, and that they come together."""

import json

import pytest

from grammarbt.bt.vocabulary import Vocabulary
from grammarbt.grammar import GrammarFileError, Source, bind, load_grammar
from grammarbt.grammar.check import check_source

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
