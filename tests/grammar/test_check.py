"""What `check` finds out about grammars that can be used."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from grammarbt.bt import format_tree, parse
from grammarbt.cli.grammar_check import command
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars
from grammarbt.grammar.ambiguity import find_ambiguity, smallest_word
from grammarbt.grammar.check import check, check_source
from grammarbt.grammar.finite import is_finite
from grammarbt.grammar.usage import Usage

HEAD = "%declare ACTION CONDITION\n"


def findings(name, vocabulary, code):
    report = check(load_grammar(shipped_grammars()[name]), vocabulary)
    return [finding for finding in report.findings if finding.code == code]


def language(text, vocabulary):
    return bind(load_grammar(Source("x.grammar", HEAD + text)), vocabulary)


def test_groups_of_a_single_action_are_reported_with_reason_and_repair(vocabulary, marine_sizes):
    found = findings("scheide", vocabulary(*marine_sizes), "G407")
    assert [finding.message for finding in found] == [
        "group `g5` cannot appear in any tree",
        "group `g6` cannot appear in any tree",
    ]
    assert found[0].notes[0] == '`"→" "(" ACTION{g} right{g} ")"` needs 2 different leaves out of [a5.0]'
    assert len(found[0].notes) == 4
    assert findings("marine", vocabulary(*marine_sizes), "G407") == []


def test_the_repair_that_is_offered_repairs(vocabulary, marine_sizes):
    (first, _) = findings("scheide", vocabulary(*marine_sizes), "G407")
    alternative = first.help.split("add `| ")[1].split("` to")[0]
    text = shipped_grammars()["scheide"].text
    repaired = text.replace("subtree{g}: ", f"subtree{{g}}: {alternative} | ", 1)
    report = check_source(Source("x.grammar", repaired), vocabulary(*marine_sizes))
    assert [finding.code for finding in report.findings] == ["G501"]


def test_a_group_without_actions_is_told_to_get_one(vocabulary):
    (finding,) = findings("marine", vocabulary((1, 1), (1, 1), (0, 2)), "G407")
    assert finding.help == "give the group an action"
    assert "needs ACTION{g3}, and there is none" in finding.render()


def brute_force_ambiguous(grammar, symbol):
    """Lengths of ambiguous words, by listing everything."""
    seen, lengths = set(), []
    for _, word in grammar.enumerate(symbol):
        if word in seen:
            lengths.append(len(word))
        seen.add(word)
    return lengths


@pytest.mark.parametrize("size", [(2, 1), (2, 2), (1, 3), (1, 2), (1, 1)])
@pytest.mark.parametrize("name", ["scheide", "marine"])
def test_ambiguous_word_is_a_shortest_one_and_has_both_derivations(bound, name, size):
    grammar = bound(name, size, (1, 1))
    lengths = [length for block in grammar.blocks for length in brute_force_ambiguous(grammar, block)]
    found = find_ambiguity(grammar).ambiguity
    assert (found is None) == (not lengths)
    if found:
        assert len(found.word) == min(lengths)
        assert found.first != found.second
        for derivation in (found.first, found.second):
            assert grammar.derive(derivation, found.symbol).symbols == found.word


def test_a_small_language_is_proven_unambiguous(vocabulary):
    grammar = language('start: "?" "(" ACTION CONDITION+ ")"\n%limit nodes 4\n', vocabulary((2, 2)))
    assert find_ambiguity(grammar).complete
    endless = language('start: "?" "(" ACTION+ ")"\n', vocabulary((2, 2)))
    verdict = find_ambiguity(endless)
    assert (verdict.ambiguity, verdict.complete) == (None, False)


@pytest.mark.parametrize("name", ["scheide", "marine", "general", "perez", "ppa", "sized"])
def test_smallest_word_is_as_small_as_any_sampled_one(bound, name):
    grammar, rng = bound(name, (2, 2), (1, 1)), np.random.default_rng(0)
    smallest = smallest_word(grammar)
    sampled = [len(grammar.derive(grammar.sample(rng)).symbols) for _ in range(300)]
    assert len(smallest) <= min(sampled)
    assert parse(format_tree(grammar.tree_of(smallest)))


@pytest.mark.parametrize(
    ("text", "finite"),
    [
        ('start: "?" "(" ACTION ")"\n', True),
        ('start: "?" "(" ACTION+ ")"\n', False),
        ('start: "?" "(" ACTION~1..9 ")"\n', True),
        ('start: "?" "(" ACTION+ ")"\n%limit nodes 9\n', True),
        ('start: "?" "(" ACTION+ ")"\n%limit depth 9\n', False),
        ('start: "?" "(" ACTION [start] ")"\n', False),
        ('start: "?" "(" ACTION [start] ")"\n%limit depth 9\n', True),
        ('start: "?" "(" ACTION+ ")"\n%unique ACTION in start\n', True),
        ('start: "?" "(" (ACTION | CONDITION)+ ")"\n%unique ACTION in start\n', False),
        ('start: "?" "(" (ACTION | CONDITION)+ ")"\n%unique ACTION in start\n%unique CONDITION in start\n', True),
        ('start: "?" "(" part+ ")"\npart: "→" "(" ACTION+ ")"\n%unique ACTION in part\n', False),
        ('start: "?" "(" part ")"\npart: "→" "(" ACTION [part] ")"\n%unique ACTION in part\n', True),
    ],
)
def test_finite_languages_are_told_from_infinite_ones(vocabulary, text, finite):
    words = vocabulary((2, 2))
    assert check_source(Source("x.grammar", HEAD + text), words).summary.finite is finite
    grammar = language(text, words)
    if finite:
        assert len(list(grammar.enumerate(most=20_000))) < 20_000


def test_finiteness_looks_only_at_what_can_be_used(vocabulary):
    text = 'start: "?" "(" ACTION ")" | "→" "(" loop CONDITION ")"\nloop: CONDITION loop | CONDITION\n'
    grammar = language(text, vocabulary((2, 0)))
    assert is_finite(grammar, Usage(grammar, (), ()).usable)


def test_without_a_domain_leaves_are_made_up_for_the_grammar():
    text = HEAD + 'start: "→" "(" "(battery(level=3))" ACTION{mines} "[stop]" CONDITION ")"\n'
    assert check_source(Source("x.grammar", text)).findings == ()
    wrong = text.replace("(battery", "(!battery").replace('"[stop]"', '"!" "(" "[stop]" "[go]" ")"')
    assert {finding.code for finding in check_source(Source("x.grammar", wrong)).findings} >= {"G302"}


def test_the_counter_is_asked_only_about_finite_languages(vocabulary):
    words = vocabulary((2, 2))
    finite, infinite = (HEAD + f'start: "?" "(" (ACTION | CONDITION){sign} ")"\n' for sign in ("~2", "+"))
    assert check_source(Source("x", finite), words, lambda _: 16).summary.words == 16
    assert check_source(Source("x", infinite), words, lambda _: 1 / 0).summary.words is None


def run(*arguments):
    return CliRunner().invoke(command, arguments, obj=((), False), standalone_mode=False)


def test_command_prints_findings_and_figures(tmp_path):
    path = tmp_path / "mine.grammar"
    path.write_text(HEAD + 'start: "?" "(" ACTION ")"\n')
    result = run(str(path))
    assert result.return_value == 0
    assert "warning[G210]" in result.output
    assert result.output.endswith("0 errors, 1 warning\n")


def test_command_gives_one_json_object_and_fails_on_errors(tmp_path):
    path = tmp_path / "mine.grammar"
    path.write_text('start: "?" "(" each ")"\n')
    result = run(str(path), "--json")
    assert result.return_value == 2
    assert [finding["code"] for finding in json.loads(result.output)["diagnostics"]] == ["G201"]
