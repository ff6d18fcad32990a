"""Every word is proposed once the search ends, and good productions are tried more often."""

from grammarbt_uct.parameters import UctParameters
from grammarbt_uct.search import Uct


def test_a_finished_language_closes_the_root(context, drive, grammar):
    words = {grammar.tree_of(word) for _, word in grammar.enumerate() if len(word) < 8}
    searcher = Uct(context(), UctParameters())
    proposals = drive(searcher, 100_000, width=7)
    assert words <= {proposal.tree for proposal in proposals}
    assert searcher.metrics()["finished"] == 1.0
    assert searcher.ask(3) == []


def test_good_words_come_more_often_with_time(context, drive, names):
    proposals = drive(Uct(context(), UctParameters()), 600, width=1)
    early, late = ([names(one.tree).count("a") for one in part] for part in (proposals[:150], proposals[-150:]))
    assert sum(late) > sum(early)


def test_without_exploration_fewer_nodes_are_selected_again(context, drive, names):
    shares = []
    for c in (0.0, 5.0):
        proposals = drive(Uct(context(), UctParameters(c=c)), 500, width=1)
        shares.append(sum(names(one.tree).startswith("a") for one in proposals))
    assert shares[0] > shares[1]
