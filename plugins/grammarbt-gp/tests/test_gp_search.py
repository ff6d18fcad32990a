"""Small trees first, then better ones; what never acts is taken away."""

from contextlib import suppress

from grammarbt.bt.simplify import size
from grammarbt.search import Evaluation, IdleElements, Moves, Scorer, States
from grammarbt_gp.parameters import GpParameters
from grammarbt_gp.search import GeneticProgramming, Trees


def test_it_begins_with_the_smallest_trees(context, drive):
    proposals = drive(GeneticProgramming(context(), GpParameters(greedy=0.1, population=50)), 40)
    sizes = [size(proposal.tree) for proposal in proposals]
    assert sizes == sorted(sizes)
    assert sizes[0] == 2


def test_without_the_greedy_start_it_begins_with_random_trees(context, drive):
    proposals = drive(GeneticProgramming(context(), GpParameters(greedy=0.0, population=50)), 50)
    sizes = [size(proposal.tree) for proposal in proposals]
    assert sizes != sorted(sizes)
    assert max(sizes) > 4


def test_it_finds_the_best_tree(context, drive, names):
    searcher = GeneticProgramming(context(), GpParameters())
    drive(searcher, 1_000)
    assert names(searcher.candidates(1)[0]) == "aaaaaa"


def test_a_parent_loses_what_was_never_ticked(context):
    states = States(context().grammar)
    scorer = Scorer(states)
    trees = Trees(context(), GpParameters(), states, scorer)
    moves = Moves(context().grammar, states)
    derivation = next(d for d, w in context().grammar.enumerate() if size(states.tree(d)) == 5 and len(d) > 8)
    batches = scorer.score([derivation])
    (proposal,) = next(batches)
    ticks = (3, 0, 1, 1)
    with suppress(StopIteration):
        batches.send([Evaluation(proposal, (1.0, 1.0), ticks)])
    trimmed = trees.trimmed(derivation)
    assert trimmed.steps == IdleElements(moves).removed(moves.tree(derivation), ticks, context().rng).steps
    assert size(states.tree(trimmed.steps)) == 4
