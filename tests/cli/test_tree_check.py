"""`grammarbt tree check` tells what can never run, what was never visited, and what each sub-tree is worth."""

import json

import pytest
from corridor_runs import CORRIDOR

from grammarbt.cli import main

MANUAL = "?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )"
HALF = "?( →( (holding cup) [go to door] ) [go to cup] →( (at cup) !(at cup) [grasp] ) )"


def check(capsys, tree, *arguments):
    code = main(["tree", "check", tree, "--domain", CORRIDOR, *arguments])
    return code, capsys.readouterr().out


def test_dead_leaves_are_found_without_simulating(capsys):
    code, out = check(capsys, HALF)
    assert code == 0
    assert out.splitlines() == ["[grasp] can never run (leaf 6)"]
    assert "no leaf is dead" in check(capsys, MANUAL)[1]


def test_what_the_domain_declares_of_its_actions_counts(capsys):
    # random walk never fails in the marine domain, so nothing after it runs
    assert main(["tree", "check", "?( [random walk] [report] )", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["dead"] == [{"leaf": "[report]", "occurrence": 1}]
    assert set(found) == {"tree", "domain", "dead"}


def test_the_json_holds_every_node_and_every_sub_tree(capsys):
    code, out = check(capsys, HALF, "--episodes", "20", "--seed", "3", "--json")
    found = json.loads(out)
    assert code == 0
    assert (found["tree"], found["domain"], found["episodes"], found["counted"]) == (HALF, CORRIDOR, 20, "ticks")
    assert [node["node"] for node in found["nodes"]] == [
        "?", "→", "(holding cup)", "[go to door]", "[go to cup]", "→", "(at cup)", "!", "(at cup)", "[grasp]",
    ]  # fmt: skip
    assert [node["parent"] for node in found["nodes"]] == [None, 0, 1, 1, 0, 0, 5, 5, 7, 5]
    keys = {"node", "parent", "place", "visits", "success", "failure", "running"}
    assert {frozenset(node) for node in found["nodes"]} == {frozenset(keys)}
    assert found["never"] == [node["place"] for node in found["nodes"] if not node["visits"]] == [3, 5, 6, 7, 8, 9]
    assert found["coverage"] == pytest.approx(40)
    assert [set(change) for change in found["ablation"]] == [{"place", "subtree", "change", "low", "high"}] * 8


def test_the_table_has_a_line_for_each_node(capsys):
    lines = check(capsys, HALF, "--episodes", "20")[1].splitlines()
    assert any(line.endswith("│  └─ [go to door]") and "never" in line for line in lines)
    assert "visited 4 of 10 nodes, 40.0 %" in lines


@pytest.mark.parametrize(("percent", "code"), [("0", 0), ("40", 0), ("40.1", 1), ("100", 1)])
def test_coverage_sets_the_exit_code(capsys, percent, code):
    assert check(capsys, HALF, "--episodes", "20", "--coverage", percent)[0] == code


def test_the_same_seed_gives_the_same_answer_and_another_seed_another(capsys):
    first, again, other = (check(capsys, MANUAL, "--episodes", "20", "--seed", seed, "--json")[1] for seed in "112")
    assert first == again != other


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["?( [grasp"], "never closed"),
        (["?( [grap] )"], "no leaf [grap]"),
        (["nowhere.tree"], "no file 'nowhere.tree'"),
        (["x" * 5000], "no file"),
        ([MANUAL, "--episodes", "0"], "cannot be 0"),
        ([MANUAL, "--coverage", "90"], "needs episodes"),
        ([MANUAL, "--episodes", "9", "--coverage", "101"], "cannot be 101"),
        ([MANUAL, "--episodes", "9", "--coverage", "nan"], "cannot be nan"),
        ([MANUAL, "--set", "domain.cells=1"], "domain.cells"),
        ([MANUAL, "--seed", "-1"], "seed"),
    ],
)
def test_a_mistake_is_one_line_and_exit_2(capsys, arguments, message):
    assert main(["tree", "check", "--domain", CORRIDOR, *arguments]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert message in shown.err.splitlines()[0]


def test_notation_may_be_longer_than_the_name_of_a_file(capsys):
    long = f"?( {' '.join([MANUAL] * 20)} )"
    assert main(["tree", "convert", long, "--to", "notation"]) == 0
    assert capsys.readouterr().out.strip() == long
