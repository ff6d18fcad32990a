import pytest
from attrs import evolve

from grammarbt.bt import behave_alike, parse
from grammarbt.errors import GrammarBTError
from grammarbt.search import BlockDag, Stream, behaviour_of
from grammarbt.testing import errands
from grammarbt_compose.parameters import ComposeParameters
from grammarbt_compose.search import Compose

NESTED = """
%declare ACTION CONDITION
%limit nodes 12
start: "?" "(" part+ ")"
part: ACTION | "→" "(" CONDITION+ part ")"
"""
LISTS = errands()
NESTS = errands(NESTED, "?( →( (hungry) →( (full) [cook] ) ) →( (tired) [sleep] ) [walk] )")


def run(puzzle, episodes, batch=1, start=None, **parameters):
    searcher = Compose(puzzle.context(budget=1_500, start=start), ComposeParameters(**parameters))
    return searcher, puzzle.drive(searcher, episodes, batch)


@pytest.mark.parametrize("batch", [1, 6])
def test_it_composes_the_goal_from_noisy_returns(batch):
    searcher, _ = run(LISTS, 1_500, batch)
    assert behave_alike(searcher.candidates(1)[0], LISTS.solution)


def test_it_finds_the_goal_where_trees_are_no_lists_of_groups():
    searcher, _ = run(evolve(NESTS, noise=0.0), 4_000, round_episodes=1_000)
    assert behave_alike(searcher.candidates(1)[0], NESTS.solution)


@pytest.mark.parametrize("puzzle", [LISTS, NESTS], ids=["lists", "nests"])
def test_same_seed_gives_the_same_proposals(puzzle):
    assert run(puzzle, 300)[1] == run(puzzle, 300)[1]


@pytest.mark.parametrize("puzzle", [LISTS, NESTS], ids=["lists", "nests"])
def test_every_derivation_gives_the_proposed_tree(puzzle):
    for proposal in run(puzzle, 300)[1]:
        assert puzzle.grammar.tree(puzzle.grammar.derive(proposal.derivation)) == proposal.tree


@pytest.mark.parametrize("puzzle", [LISTS, NESTS], ids=["lists", "nests"])
def test_it_begins_from_the_start_tree(puzzle):
    searcher, proposals = run(puzzle, 200, start=puzzle.solution)
    assert puzzle.solution in {proposal.tree for proposal in proposals[:14]}
    assert behave_alike(searcher.candidates(1)[0], puzzle.solution)


@pytest.mark.parametrize("puzzle", [LISTS, NESTS], ids=["lists", "nests"])
def test_a_start_tree_outside_the_language_is_one_line(puzzle):
    with pytest.raises(GrammarBTError):
        Compose(puzzle.context(start=parse("→( [walk] [walk] )")), ComposeParameters())


def test_a_stream_gives_every_behaviour_once_before_any_again():
    given = LISTS.context()
    dag = BlockDag(given.grammar, given.grammar.blocks[0], behaviour_of(given), 1_000)
    stream = Stream(dag)
    first = [stream.draw(given.rng)[1] for _ in range(dag.words - 4)]
    assert len(set(first)) == len(first)
    assert len({stream.draw(given.rng)[1] for _ in range(3 * dag.words)} | set(first)) == dag.words
