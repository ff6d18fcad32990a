"""Every word is proposed once the search ends, and good productions are tried more often."""

from grammarbt.bt import leaves
from grammarbt.testing import letters
from grammarbt_uct.parameters import UctParameters
from grammarbt_uct.search import Uct

PUZZLE = letters()


def test_a_finished_language_closes_the_root():
    grammar = PUZZLE.grammar
    words = {grammar.tree_of(word) for _, word in grammar.enumerate() if len(word) < 8}
    searcher = Uct(PUZZLE.context(), UctParameters())
    proposals = PUZZLE.drive(searcher, 100_000, width=7)
    assert words <= {proposal.tree for proposal in proposals}
    assert searcher.metrics()["finished"] == 1.0
    assert searcher.ask(3) == []


def test_good_words_come_more_often_with_time():
    proposals = PUZZLE.drive(Uct(PUZZLE.context(), UctParameters()), 600)
    worth = [PUZZLE.value(proposal.tree) for proposal in proposals]
    assert sum(worth[-150:]) > sum(worth[:150])


def test_without_exploration_fewer_nodes_are_selected_again():
    shares = []
    for c in (0.0, 5.0):
        proposals = PUZZLE.drive(Uct(PUZZLE.context(), UctParameters(c=c)), 500)
        shares.append(sum(leaves(one.tree)[0].name == "a" for one in proposals))
    assert shares[0] > shares[1]
