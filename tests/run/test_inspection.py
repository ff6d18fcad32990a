"""What is said of a tree's nodes, against py_trees ticking the same worlds and against plain arithmetic."""

from collections import Counter
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import py_trees
import pytest
from attrs import frozen

from grammarbt.bt import Status, format_tree, leaves, numbered, parse, walk
from grammarbt.bt.formats import py_trees as py_trees_format
from grammarbt.domain import FIRST_VALIDATION_SCENARIO, Watchable, scenario_numbers
from grammarbt.errors import DomainError
from grammarbt.run.inspection import inspect_tree
from grammarbt.run.score import Validator

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "corridor.py"
TREES = (
    "?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )",
    "?( →( (holding cup) [go to door] ) →( [go to cup] !(!([grasp])) ) (at cup) [grasp] )",
    "→( ?( (holding cup) →( [go to cup] [grasp] ) ) !( !( [go to door] ) ) [go to cup] )",
)
EPISODES, SEED = 20, 7


def corridor():
    spec = spec_from_file_location("corridor_to_inspect", EXAMPLE)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Corridor()


@frozen
class Unwatched:
    """A domain that says no more than its returns and how often each leaf was ticked."""

    inner: object

    vocabulary = property(lambda self: self.inner.vocabulary)
    references = property(lambda self: self.inner.references)

    def simulate(self, policy, scenarios):
        return self.inner.simulate(policy, scenarios)


class Robot:
    """What the exported py_trees module asks."""

    def __init__(self, world):
        self.world = world

    def condition(self, name, /):
        return self.world.condition(name)

    def action(self, name, /):
        return py_trees.common.Status[self.world.action(name).name]

    def halt(self, name, /):
        pass


def counted_by_py_trees(tree):
    """Per node in pre-order, how often py_trees gave it each status."""
    module, world, found = {}, corridor(), [Counter() for _ in walk(tree)]
    exec(py_trees_format.dumps(tree), module)  # noqa: S102 - the exported file is what is run
    first = FIRST_VALIDATION_SCENARIO
    for scenario in scenario_numbers(SEED, first, first + EPISODES):
        root = module["create_root"](Robot(world))
        places = {node.id: place for place, node in enumerate(pre_order(root))}
        world.reward, world.done = 0.0, False
        world.reset(np.random.default_rng(scenario))
        while not world.done:
            for node in root.tick():
                found[places[node.id]][node.status.name] += 1
            world.step()
    return found


def pre_order(node):
    yield node
    for child in node.children:
        yield from pre_order(child)


@pytest.mark.parametrize("text", TREES)
def test_every_node_is_counted_as_py_trees_counts_it(text):
    tree = parse(text)
    seen = inspect_tree(tree, corridor(), SEED, EPISODES)
    counts = [Counter(SUCCESS=node.success, FAILURE=node.failure, RUNNING=node.running) for node in seen.nodes]
    assert seen.counted == "ticks"
    assert counts == counted_by_py_trees(tree)
    assert [node.visits for node in seen.nodes] == [count.total() for count in counts]


@pytest.mark.parametrize("text", TREES)
def test_leaves_alone_tell_the_same_visits(text):
    domain = Unwatched(corridor())
    assert not isinstance(domain, Watchable)
    alone = inspect_tree(parse(text), domain, SEED, EPISODES)
    seen = inspect_tree(parse(text), corridor(), SEED, EPISODES)
    assert alone.counted == "leaves"
    assert [node.visits for node in alone.nodes] == [node.visits for node in seen.nodes]
    assert {node.success for node in alone.nodes} == {None}
    assert alone.ablation == seen.ablation


def test_what_is_never_visited_is_listed_and_lowers_the_coverage():
    tree = parse("?( →( (holding cup) [go to door] ) →( [go to cup] ?( [grasp] (at cup) ) ) →( [grasp] [go to cup] ) )")
    seen = inspect_tree(tree, corridor(), SEED, EPISODES)
    named = [format_tree(numbered(tree)[place][0]) for place in seen.never]
    assert named == ["→( [grasp] [go to cup] )", "[grasp]", "[go to cup]"]
    assert seen.coverage == pytest.approx(100 * 9 / 12)


def test_changes_are_means_of_differences_scenario_by_scenario():
    tree, rest = parse(TREES[0]), parse("?( →( (holding cup) [go to door] ) →( [grasp] ) )")
    change = next(each for each in inspect_tree(tree, corridor(), SEED, EPISODES).ablation if each.place == 5)
    validator = Validator(corridor(), SEED)
    differences = validator.returns(rest, EPISODES) - validator.returns(tree, EPISODES)
    spread = 1.96 * differences.std(ddof=1) / EPISODES**0.5
    assert change.subtree == "[go to cup]"
    assert (change.change, change.low) == pytest.approx((differences.mean(), differences.mean() - spread))
    assert change.high == pytest.approx(differences.mean() + spread)
    assert change.high < 0


def test_taking_out_what_never_runs_changes_nothing():
    tree = parse(f"?( {TREES[0]} →( (at cup) !(at cup) [grasp] ) )")
    dead = [each for each in inspect_tree(tree, corridor(), SEED, EPISODES).ablation if each.subtree == "[grasp]"][-1]
    assert (dead.change, dead.low, dead.high) == (0, 0, 0)


def test_each_sub_tree_stands_once_in_the_table():
    tree = parse("→( !( ?( [grasp] ) ) ‖1( (at cup) [go to cup] ) )")
    assert [change.place for change in inspect_tree(tree, corridor(), SEED, 2).ablation] == [1, 4, 5, 6]
    assert inspect_tree(leaves(tree)[0], corridor(), SEED, 2).ablation == ()


def test_a_domain_that_breaks_while_watched_is_an_error_with_its_reason():
    domain = corridor()
    domain.picture = lambda: 1 / 0
    with pytest.raises(DomainError, match="ZeroDivisionError"):
        inspect_tree(parse("[grasp]"), domain, SEED, 2)


def test_a_domain_that_cannot_score_is_an_error_with_its_reason():
    domain = corridor()
    domain.action = lambda _: Status.BROKEN
    with pytest.raises(DomainError, match="BROKEN"):
        inspect_tree(parse("[grasp]"), Unwatched(domain), SEED, 2)
