"""`grammarbt tree show` draws a tree."""

import json

import pytest

from grammarbt.bt import parse
from grammarbt.bt.formats.btcpp import dumps
from grammarbt.cli import main


def test_a_drawing_shows_every_node_on_a_line_of_its_own(capsys):
    assert main(["tree", "show", "?( →( !(a b) [c] ) [d(x=1)] )"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "?",
        "├─ →",
        "│  ├─ !",
        "│  │  └─ (a b)",
        "│  └─ [c]",
        "└─ [d(x=1)]",
    ]


def test_a_file_in_another_format_is_drawn_too(capsys, tmp_path):
    file = tmp_path / "some.xml"

    file.write_text(dumps(parse("→( [a] [b] )")), encoding="utf-8")
    assert main(["tree", "show", str(file)]) == 0
    assert capsys.readouterr().out.splitlines() == ["→", "├─ [a]", "└─ [b]"]


def test_a_bad_tree_is_one_line_with_its_column_and_exit_2(capsys):
    assert main(["tree", "show", "?( [a] "]) == 2
    assert "column" in capsys.readouterr().err.splitlines()[0]


TREE = "?( →( (mine found) (is armed) [disarm] ) →( !(carrying object) [pick up] ) [random walk] )"


@pytest.mark.parametrize("name", ["notation", "tree", "btcpp", "json", "strings"])
def test_converting_to_a_two_way_format_and_back_gives_the_same_tree(capsys, tmp_path, name):
    suffix = {"notation": ".bt", "tree": ".tree", "btcpp": ".xml", "json": ".json", "strings": ".txt"}[name]
    file = tmp_path / f"some{suffix}"
    assert main(["tree", "convert", TREE, "--to", name, "-o", str(file)]) == 0
    assert main(["tree", "convert", str(file), "--to", "notation"]) == 0
    assert capsys.readouterr().out.strip() == TREE


@pytest.mark.parametrize("name", ["dot", "mermaid", "svg", "py_trees", "py_trees_xml"])
def test_every_other_format_names_every_leaf(capsysbinary, name):
    assert main(["tree", "convert", TREE, "--to", name]) == 0
    text = capsysbinary.readouterr().out.decode()
    assert all(
        leaf in text for leaf in ("mine found", "is armed", "disarm", "carrying object", "pick up", "random walk")
    )


def test_an_unknown_format_is_one_line_with_the_known_ones(capsys):
    assert main(["tree", "convert", TREE, "--to", "btcp"]) == 2
    assert "did you mean 'btcpp'" in capsys.readouterr().err


def test_equal_trees_differ_in_nothing_and_exit_0(capsys):
    assert main(["tree", "diff", "→( (a) →( (b) [c] ) )", "→( (b) (a) [c] )"]) == 0
    assert capsys.readouterr().out == "equal\n"


def test_different_trees_exit_1_with_a_shortest_difference(capsys):
    assert main(["tree", "diff", "→( (a) [b] )", "→( (a) [b] [c] )", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found["equal"] is False
    assert found["answers"] == [["(a)", "success"], ["[b]", "success"]]


def test_simplify_prints_a_smaller_tree(capsys):
    assert main(["tree", "simplify", "?( ?( (a) ) !(!(?( (b) (a) ))) )"]) == 0
    assert capsys.readouterr().out == "?( (a) (b) )\n"
