"""Edits stay in the language whatever the grammar, and annealing over them finds what it should."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import format_tree, leaves, parse
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars
from grammarbt.search import AnnealedSearch, Edits, Evaluation, GeneralSearch, Proposal, SearchContext

VOCABULARY = Vocabulary(
    (
        Group("g1", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),
        Group("g2", (ActionType("e"),), (ConditionType("f"),)),
    )
)
RIGHT = '%declare ACTION CONDITION\n%limit nodes 12\nstart: "?" "(" CONDITION* more ")"\nmore: ACTION more | start more | ACTION\n'
LEFT = '%declare ACTION CONDITION\nstart: "?" "(" pairs ")"\npairs: pairs CONDITION ACTION | ACTION\n'
NESTED = (
    "%declare ACTION CONDITION\n%limit nodes 15\nstart: fallback | sequence\n"
    'fallback: "?" "(" tries ")"\ntries: CONDITION tries | ACTION tries | sequence tries | ACTION | sequence\n'
    'sequence: "→" "(" steps ")"\nsteps: CONDITION steps | ACTION steps | fallback steps | ACTION | fallback\n'
)
WAYS = (
    '%declare ACTION CONDITION\nstart: "?" "(" ways ")"\nways: guarded ways | ACTION\n'
    'guarded: "→" "(" CONDITION ACTION ")"\n'
)
OWN = {"ways": WAYS, "right": RIGHT, "left": LEFT, "nested": NESTED}
GOAL = parse("?( →( (c) ?( (d) [a] ) [b] ) [e] )")


def bound(name):
    source = Source(f"{name}.grammar", OWN[name]) if name in OWN else shipped_grammars()[name]
    return bind(load_grammar(source), VOCABULARY)


EDITS = {name: Edits(bound(name)) for name in (*OWN, *shipped_grammars())}
KINDS = (
    "insert",
    "copy",
    "delete",
    "replace",
    "splice",
    "move",
    "shift",
    "regenerate",
    "exchange",
    "enclose",
    "convert",
    "wrap",
    "hoist",
    "swap",
)


@pytest.mark.parametrize("name", EDITS)
@settings(max_examples=25)
@given(seed=st.integers(0, 2**32))
def test_neighbours_stay_in_the_language(name, seed):
    edits, rng = EDITS[name], np.random.default_rng(seed)
    derivation = edits.sample(rng)
    other = edits.site(edits.sample(rng))
    for _ in range(5):
        found = edits.neighbour(edits.site(derivation), [other], rng)
        if found is not None:
            assert found != derivation
            tree = edits.grammar.tree(edits.grammar.derive(found))
            assert edits.states.tree(found) == tree
            derivation = found


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_edit_changes_nested_trees(kind):
    edits, rng = EDITS["nested"], np.random.default_rng(1)
    changed = 0
    for _ in range(200):
        site, other = edits.site(edits.sample(rng)), edits.site(edits.sample(rng))
        template = edits.kinds[kind](site, other, rng)
        found = None if template is None else edits.short.complete(template, rng)
        changed += found is not None and found != site.tree.steps
    assert changed > 10


def test_an_inserted_item_is_of_a_kind_that_fits_its_place():
    edits, rng = EDITS["ways"], np.random.default_rng(0)
    site = edits.site(edits.sample(rng))
    (row,) = site.rows
    found = [edits.kinds["insert"](site, site, rng) for _ in range(100)]
    longer = [template for template in found if template is not None]
    assert len(longer) > 30  # nothing may stand behind the last item
    for template in longer:
        (changed,) = edits.site(edits.short.complete(template, rng)).rows
        assert len(changed.items) == len(row.items) + 1


def test_a_shift_moves_the_border_of_a_row_and_loses_no_leaf():
    edits, rng = EDITS["nested"], np.random.default_rng(0)
    shifted = 0
    for _ in range(500):
        site = edits.site(edits.sample(rng))
        found = edits.kinds["shift"](site, site, rng)
        if found is not None:
            before, after = edits.states.tree(site.tree.steps), edits.states.tree(found)
            assert Counter(leaves(after)) == Counter(leaves(before))
            shifted += after != before
    assert shifted > 20


@pytest.mark.parametrize("name", EDITS)
@settings(max_examples=25)
@given(seed=st.integers(0, 2**32))
def test_rows_are_written_as_they_were_read(name, seed):
    edits = EDITS[name]
    site = edits.site(edits.sample(np.random.default_rng(seed)))
    for row in site.rows:
        assert site.rewritten(row, edits.sites.rows.written(row, row.items)) == site.tree.steps


def test_a_row_that_begins_with_itself_reads_left_to_right():
    edits, rng = EDITS["left"], np.random.default_rng(0)
    site = max((edits.site(edits.sample(rng)) for _ in range(50)), key=lambda site: len(site.rows[0].items))
    (row,) = site.rows
    assert len(row.items) > 2
    backwards = edits.sites.rows.written(row, [row.items[0], *row.items[:0:-1]])
    tree = edits.states.tree(edits.short.complete(site.rewritten(row, backwards), rng))
    first, *pairs = leaves(edits.states.tree(site.tree.steps))
    expected = [first, *(leaf for at in range(len(pairs) - 2, -1, -2) for leaf in pairs[at : at + 2])]
    assert list(leaves(tree)) == expected


def test_short_trees_come_first():
    edits, rng = EDITS["nested"], np.random.default_rng(0)
    sizes = [len(leaves(edits.states.tree(edits.sample(rng)))) for _ in range(300)]
    by_weight = [len(leaves(edits.grammar.tree(edits.grammar.derive(edits.grammar.sample(rng))))) for _ in range(300)]
    assert np.mean(sizes) < np.mean(by_weight)


def likeness(tree):
    """How much of the goal's text is there, less a little for every leaf: a matter of the tree, not of what it does."""
    wanted, found = format_tree(GOAL).split(), format_tree(tree).split()
    same = 0
    while same < min(len(wanted), len(found)) and wanted[same] == found[same]:
        same += 1
    return same - 0.1 * len(leaves(tree))


def run(make, value, episodes=3_000, batch=1):
    context = SearchContext(bound("nested"), VOCABULARY, np.random.default_rng(2), episodes, depends_on="tree")
    strategy = make(context, Edits(context.grammar))
    batches = strategy.batches(lambda: batch)
    asked, spent = next(batches), []
    while len(spent) < episodes:
        spent += asked
        told = [
            Evaluation(
                each,
                tuple(value(each.tree, scenario) for scenario in range(each.start, each.stop)),
                (1,) * len(leaves(each.tree)),
            )
            for each in asked
        ]
        asked = batches.send(told)
    return strategy, spent


class Annealed:
    """Rounds without end."""

    def __init__(self, context, edits, length=1_000):
        self.search = AnnealedSearch(context, edits, length)

    def batches(self, width):
        while True:
            yield from self.search.round(width)

    def candidates(self, n):
        return self.search.candidates(n)


@pytest.mark.parametrize("batch", [1, 4])
def test_annealing_finds_the_goal(batch):
    strategy, spent = run(Annealed, lambda tree, _: likeness(tree), batch=batch)
    assert strategy.candidates(1) == (GOAL,)
    assert len({proposal.derivation for proposal in spent}) == len(spent)


def test_the_last_rounds_begin_from_the_best_trees():
    strategy, _ = run(lambda *given: Annealed(*given, length=100), lambda tree, _: likeness(tree), episodes=2_000)
    search = strategy.search
    assert search.rounds > 3
    assert search.elites[0].derivation in search.begun


def test_a_tree_is_among_the_best_once_and_rounds_may_begin_from_it_again():
    strategy, _ = run(lambda *given: Annealed(*given, length=50), lambda tree, _: likeness(tree), episodes=4_000)
    search = strategy.search
    assert len({elite.derivation for elite in search.elites}) == len(search.elites)
    assert search.begun[search.elites[0].derivation] > 1


def test_what_costs_no_budget_makes_no_round_shorter():
    context = SearchContext(bound("nested"), VOCABULARY, np.random.default_rng(2), 2_000)
    search = AnnealedSearch(context, Edits(context.grammar), 100)
    batches = search.round(lambda: 1)
    asked = next(batches)
    for known in (True, False):
        before = search.simulated
        ticks = () if known else (1,) * len(leaves(asked[0].tree))
        asked = batches.send([Evaluation(asked[0], (1.0,), ticks)])
        assert search.simulated == before + (not known)


class Raced:
    """Stands for a strategy that races: proposes one tree for ever."""

    def __init__(self, edits, rng):
        self.edits, self.rng, self.begun = edits, rng, False

    def batches(self, width):
        self.begun = True
        while True:
            derivation = self.edits.sample(self.rng)
            yield [self._proposal(derivation)]

    def _proposal(self, derivation):
        return Proposal(self.edits.states.tree(derivation), derivation)

    def candidates(self, n):
        return ()

    def metrics(self):
        return {}


def general(context, edits):
    return GeneralSearch(AnnealedSearch(context, edits, 200), Raced(edits, context.rng))


def test_where_scenarios_do_not_matter_it_anneals():
    strategy, _ = run(general, lambda tree, _: likeness(tree), episodes=2_000)
    assert not strategy.raced.begun
    assert strategy.annealed.rounds >= 2


def test_where_scenarios_matter_it_races():
    strategy, _ = run(general, lambda tree, scenario: likeness(tree) + 9.0 * (scenario % 3), episodes=100)
    assert strategy.raced.begun
    assert strategy.annealed.rounds == 0


def test_a_good_tree_that_depends_on_the_scenario_ends_the_annealing():
    def value(tree, scenario):
        known = likeness(tree)
        return known + (9.0 * (scenario % 3) if known > 4 else 0.0)

    strategy, _ = run(general, value, episodes=1_500)
    assert strategy.raced.begun
    assert strategy.annealed.rounds >= 1


def test_scenarios_that_matter_little_beside_the_gain_do_not_end_the_annealing():
    def value(tree, scenario):
        known = likeness(tree)
        return 20.0 * known + (5.0 * (scenario % 2) if known > 4 else 0.0)

    strategy, _ = run(general, value, episodes=1_500)
    assert max(20.0 * likeness(tree) for tree in strategy.candidates(3)) > 80
    assert not strategy.raced.begun
