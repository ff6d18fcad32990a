"""`grammarbt tree show` draws a tree."""

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
