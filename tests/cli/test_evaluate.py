"""`grammarbt evaluate` measures on the worlds that a run validates on."""

import json
from pathlib import Path

import pytest
from corridor_runs import CORRIDOR

from grammarbt.cli import main

MANUAL = "?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )"


@pytest.fixture
def evaluate(capsys):
    """The JSON that `evaluate` prints."""

    def call(tree, *arguments):
        assert main(["evaluate", tree, "--domain", CORRIDOR, "--json", *arguments]) == 0
        return json.loads(capsys.readouterr().out)

    return call


def test_the_json_is_the_documented_one(evaluate):
    assert set(evaluate(MANUAL, "--episodes", "40")) == {"mean", "stderr", "episodes"}


def test_the_same_seed_gives_the_same_value_and_another_seed_another(evaluate):
    first = evaluate(MANUAL, "--episodes", "40", "--seed", "1")
    assert evaluate(MANUAL, "--episodes", "40", "--seed", "1") == first
    assert evaluate(MANUAL, "--episodes", "40", "--seed", "2")["mean"] != first["mean"]


def test_notation_a_file_and_a_run_folder_mean_the_same_tree(evaluate, tmp_path):
    (tmp_path / "manual.bt").write_text(MANUAL, encoding="utf-8")
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "best.tree").write_text(MANUAL + "\n", encoding="utf-8")
    values = [evaluate(str(tree), "--episodes", "40") for tree in (MANUAL, tmp_path / "manual.bt", tmp_path / "run")]
    assert values[0] == values[1] == values[2]


def test_a_run_reports_the_value_that_evaluate_finds(evaluate, tmp_path, capsys):
    folder = str(tmp_path / "run")
    options = ["--searcher", "random", "--budget", "100", "--validation", "60", "--seed", "4", "--json", "--quiet"]
    assert main(["run", "--domain", CORRIDOR, "--out", folder, *options]) == 0
    result = json.loads(capsys.readouterr().out)
    found = evaluate(folder, "--episodes", "60", "--seed", "4")
    assert (found["mean"], found["stderr"]) == (result["value"], result["stderr"])


def test_functional_says_which_sub_trees_work(evaluate):
    found = evaluate("?( →( (holding cup) [go to door] ) [go to cup] )", "--episodes", "40", "--functional")
    assert found["complete"] is False
    assert [set(part) for part in found["functional"]] == [{"subtree", "group", "drop", "stderr", "works"}] * 2
    assert [part["group"] for part in found["functional"]] == ["deliver", "fetch"]
    assert evaluate(MANUAL, "--episodes", "40", "--functional")["complete"] is True


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["?( [grasp"], "never closed"),
        (["nowhere.bt"], "no file 'nowhere.bt'"),
        (["[dance]"], "dance"),
        ([MANUAL, "--episodes", "0"], "cannot be 0"),
        ([MANUAL, "--set", "searcher.c=1"], "searcher.c"),
        ([MANUAL, "--set", "domain.cells=1"], "domain.cells"),
        ([str(Path(__file__).parent)], "holds no best.tree"),
    ],
)
def test_a_mistake_is_one_line_and_exit_2(capsys, arguments, message):
    assert main(["evaluate", "--domain", CORRIDOR, *arguments]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert message in shown.err.splitlines()[0]
