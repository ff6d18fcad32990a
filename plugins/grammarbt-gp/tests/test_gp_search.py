"""Small trees first, then better ones; what never acts is taken away."""

from contextlib import suppress

from grammarbt.bt.simplify import size
from grammarbt.search import Evaluation, IdleElements, Moves, Scorer, States
from grammarbt.testing import letters
from grammarbt_gp.parameters import GpParameters
from grammarbt_gp.search import GeneticProgramming, Trees

PUZZLE = letters()


def test_it_begins_with_the_smallest_trees():
    searcher = GeneticProgramming(PUZZLE.context(), GpParameters(greedy=0.1, population=50))
    proposals = PUZZLE.drive(searcher, 40, width=4)
    sizes = [size(proposal.tree) for proposal in proposals]
    assert sizes == sorted(sizes)
    assert sizes[0] == 2


def test_without_the_greedy_start_it_begins_with_random_trees():
    searcher = GeneticProgramming(PUZZLE.context(), GpParameters(greedy=0.0, population=50))
    proposals = PUZZLE.drive(searcher, 50, width=4)
    sizes = [size(proposal.tree) for proposal in proposals]
    assert sizes != sorted(sizes)
    assert max(sizes) > 4


def test_a_new_population_does_not_begin_with_the_smallest_trees_again():
    searcher = GeneticProgramming(PUZZLE.context(), GpParameters(greedy=0.1, population=50))
    trees = searcher.strategy.species
    smallest = trees.first(50)
    assert trees.first(50)[:40] == smallest[:40]
    PUZZLE.drive(searcher, 60)
    assert trees.first(50)[:40] != smallest[:40]


def test_it_finds_the_best_tree():
    searcher = GeneticProgramming(PUZZLE.context(), GpParameters())
    PUZZLE.drive(searcher, 1_000, width=4)
    assert searcher.candidates(1)[0] == PUZZLE.solution


def test_a_parent_loses_what_was_never_ticked():
    context = PUZZLE.context()
    states = States(context.grammar)
    scorer = Scorer(states)
    trees = Trees(context, GpParameters(), states, scorer)
    moves = Moves(context.grammar, states)
    derivation = next(d for d, w in context.grammar.enumerate() if size(states.tree(d)) == 5 and len(d) > 8)
    batches = scorer.score([derivation])
    (proposal,) = next(batches)
    ticks = (3, 0, 1, 1)
    with suppress(StopIteration):
        batches.send([Evaluation(proposal, (1.0, 1.0), ticks)])
    trimmed = trees.trimmed(derivation)
    assert trimmed.steps == IdleElements(moves).removed(moves.tree(derivation), ticks, context.rng).steps
    assert size(states.tree(trimmed.steps)) == 4
