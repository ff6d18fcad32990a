"""The final selection and the ablation."""

import pytest

from grammarbt.bt import format_tree, parse
from grammarbt.domain import Reference
from grammarbt.run.ablate import Ablator
from grammarbt.run.evaluate import Evaluator
from grammarbt.run.score import Validator
from grammarbt.run.select import FIRST_SELECTION_SCENARIO, SuccessiveHalving

WORDS = ["(left lit)", "[light left]", "→( [light left] [light right] )", "(right lit)", "!(left lit)"]


def test_the_best_candidate_wins_within_the_budget(lamps):
    evaluator, trials = Evaluator(lamps(), 0), []
    best = SuccessiveHalving(evaluator, trials.append).best([parse(word) for word in WORDS], 60)
    assert format_tree(best) == WORDS[2]
    assert 0 < evaluator.episodes <= 60
    assert all(trial.evaluation.proposal.start == FIRST_SELECTION_SCENARIO for trial in trials)


@pytest.mark.parametrize("budget", range(12))
def test_any_budget_is_respected_and_gives_a_candidate(lamps, budget):
    evaluator, trees = Evaluator(lamps(), 0), [parse(word) for word in WORDS]
    assert SuccessiveHalving(evaluator, lambda _: None).best(trees, budget) in trees
    assert evaluator.episodes <= budget


def test_one_bad_world_does_not_lose_the_best_candidate(lamps):
    class OneBadWorld(lamps):
        def reset(self, rng):
            super().reset(rng)
            if self.pay > 11.5:
                raise RuntimeError("a bad world")

    evaluator, trials = Evaluator(OneBadWorld(), 0), []
    best = SuccessiveHalving(evaluator, trials.append).best([parse(word) for word in WORDS], 400)
    assert any(trial.evaluation.status == "failed" for trial in trials)
    assert format_tree(best) == WORDS[2]
    assert evaluator.episodes <= 400


def test_candidates_of_one_behaviour_race_once(lamps):
    evaluator = Evaluator(lamps(), 0)
    SuccessiveHalving(evaluator, lambda _: None).best([parse("[light left]"), parse("→( [light left] )")], 50)
    assert evaluator.episodes == 0


def test_the_reference_is_complete_and_each_sub_tree_works(lamps):
    ablator = Ablator(Validator(lamps(), 0), 50)
    found = ablator.ablate(parse(lamps.references[0].tree))
    assert found.complete is True
    assert [(part.group, part.works) for part in found.functional] == [("left", True), ("right", True)]
    assert all(9 < part.drop < 11 for part in found.functional)


def test_a_tree_without_a_group_is_not_complete(lamps):
    found = Ablator(Validator(lamps(), 0), 50).ablate(parse("?( →( (right lit) [light right] ) [light left] )"))
    assert found.complete is False
    assert [(part.group, part.works) for part in found.functional] == [("right", False), ("left", True)]


def test_a_group_works_although_each_of_its_two_sub_trees_could_go(lamps):
    tree = parse("→( [light left] [light left] [light right] )")
    found = Ablator(Validator(lamps(), 0), 50).ablate(tree)
    assert [part.works for part in found.functional] == [False, False, True]
    assert found.complete is True


TWICE = "?( →( [light right] !([light right]) ) [light right] )"


@pytest.mark.parametrize(("other", "complete"), [(TWICE, True), ("[light right]", False)])
def test_a_group_that_a_reference_as_good_as_the_first_does_without_does_not_matter(lamps, other, complete):
    class Dimmer(lamps):
        """The right lamp can be turned up once, and then pays as much as both."""

        references = (*lamps.references, Reference("other", other))

        def reset(self, rng):
            super().reset(rng)
            self.turns = 0

        def action(self, name):
            self.turns += name == "light right"
            return super().action(name)

        def step(self):
            self.done = True
            self.reward = self.pay * (self.lit["left"] + min(self.turns, 2))

    assert Ablator(Validator(Dimmer(), 0), 50).ablate(parse(TWICE)).complete is complete
