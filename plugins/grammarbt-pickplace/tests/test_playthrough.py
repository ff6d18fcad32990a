"""Episodes told as text, as they were recorded; one can check them by hand against the rules."""

from pathlib import Path

import pytest
from pickplace_reference import PlainPickPlace

from grammarbt.bt import parse
from grammarbt_pickplace.tasks import TASKS


@pytest.mark.parametrize("task", ["S1", "S3"])
def test_the_best_known_tree_goes_through_the_recorded_steps(task):
    tree = parse(TASKS[task].references[0].tree)
    run = PlainPickPlace(TASKS[task]).run(tree, 0, 0)
    run.play(tree)
    recorded = Path(__file__).with_name(f"playthrough_{task}.txt").read_text(encoding="utf-8")
    assert "\n".join(run.log) + "\n" == recorded
