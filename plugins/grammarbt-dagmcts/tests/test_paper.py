import pytest

from grammarbt.search import block_derivations, leftmost
from grammarbt_dagmcts.dag import ROOT, Dag
from grammarbt_dagmcts.paper import PaperSearch
from grammarbt_dagmcts.parameters import DagMctsParameters


@pytest.fixture
def grown(search):
    searcher, _ = search(200, preset="paper", restart_every=0)
    return searcher.strategy.search


def test_a_node_is_joined_to_every_parent_that_was_there_before(grown, grammar):
    dag = grown.dag
    known = {dag.form(node): node for node in range(len(dag))}
    assert len(known) == len(dag)
    for form, node in known.items():
        above = {known[parent] for parent, _ in grammar.parents(form) if parent in known}
        assert {parent for parent in above if parent < node} <= set(dag.edges.parents(node)) <= above


def test_every_edge_is_one_production_at_the_place_it_names(grown, grammar):
    edges = grown.dag.edges
    for edge in range(1, len(edges) + 1):
        parent = grown.dag.form(edges.parent[edge])
        after = grammar.apply(parent, edges.production[edge], grammar.positions(parent)[edges.place[edge]])
        assert after == grown.dag.form(edges.child[edge])


def test_edges_are_listed_from_both_their_ends(grown):
    edges = grown.dag.edges
    for edge in range(1, len(edges) + 1):
        assert edge in edges.below(edges.parent[edge])
        assert edge in edges.above(edges.child[edge])
    assert sum(len(edges.children(node)) for node in range(len(grown.dag))) == len(edges)


@pytest.mark.parametrize("settings", [{"preset": "paper", "restart_every": 0}, {"preset": "mcdags", "restarts": False}])
def test_a_node_knows_its_children_that_are_open(search, settings):
    dag = search(600, **settings)[0].strategy.search.dag
    assert any(dag.closed)
    for node in range(len(dag)):
        edges, children = dag.open_below(node)
        assert [*edges] == [edge for edge in dag.edges.below(node) if not dag.closed[dag.edges.child[edge]]]
        assert [*children] == [dag.edges.child[edge] for edge in edges]


def test_some_nodes_have_several_parents(grown):
    assert max(len(grown.dag.edges.parents(node)) for node in range(len(grown.dag))) > 1


def test_each_ancestor_is_credited_once_per_roll_out(context, answer):
    strategy = PaperSearch(context(), DagMctsParameters(preset="paper", restart_every=0))
    batches = strategy.batches(lambda: 1)
    proposals = next(batches)
    dag = strategy.search.dag
    for _ in range(80):
        before = [(dag.rewards.visits[node], dag.edges.parents(node)) for node in range(len(dag))]
        proposals = batches.send([answer(proposal) for proposal in proposals])
        gained = [dag.rewards.visits[node] - visits for node, (visits, _) in enumerate(before)]
        assert set(gained) <= {0, 1}
        assert gained[ROOT] == 1
        assert all(gained[parent] for node, (_, parents) in enumerate(before) if gained[node] for parent in parents)


def descendant(grammar, steps):
    form = grammar.start()
    for _ in range(steps):
        form = grammar.apply(form, grammar.legal(form)[-1])
    return form


def test_linked_forms_lie_within_k_inverse_productions(grammar):
    dag = Dag(grammar)
    node = dag.add(dag.spelling.text(descendant(grammar, 6)))
    dag.link_ancestors(node, 6, 10_000)
    assert ROOT in dag.edges.ancestors([node])
    for other in range(len(dag)):
        assert other == node or dag.form(node) in _below(grammar, dag.form(other), 6)


def test_every_way_from_a_linked_ancestor_is_joined(grammar):
    dag = Dag(grammar)
    node = dag.add(dag.spelling.text(descendant(grammar, 6)))
    dag.link_ancestors(node, 6, 10_000)
    known = {dag.form(other): other for other in range(len(dag))}
    for form, other in known.items():
        assert set(dag.edges.parents(other)) == {known[above] for above, _ in grammar.parents(form) if above in known}


def test_ancestors_further_than_k_stay_unlinked(grammar):
    dag = Dag(grammar)
    node = dag.add(dag.spelling.text(descendant(grammar, 6)))
    dag.link_ancestors(node, 3, 10_000)
    assert len(dag) == 2
    assert ROOT not in dag.edges.ancestors([node])


def _below(grammar, form, steps):
    layer = {form}
    for _ in range(steps):
        layer |= {
            grammar.apply(one, production, at)
            for one in layer
            for at in grammar.positions(one)
            for production in grammar.legal(one, at)
        }
    return layer


def test_ancestor_links_join_more_nodes(search):
    plain, _ = search(150, preset="paper", ancestor_links=False)
    linked, _ = search(150, preset="paper")
    assert linked.metrics()["edges"] > plain.metrics()["edges"]


def test_good_sub_trees_become_productions_at_a_restart(search, grammar):
    searcher, _ = search(250, preset="paper", restart_every=100, macros=4)
    extended = searcher.strategy.search.grammar
    assert searcher.metrics()["restarts"] == 2
    extra = extended.productions[len(grammar.productions) :]
    assert len(extra) == searcher.metrics()["macros"] == 4
    assert all(production.lhs in grammar.blocks for production in extra)


def test_without_macros_a_restart_keeps_the_grammar(search, grammar):
    searcher, _ = search(250, preset="paper", restart_every=100, macros=0)
    assert searcher.metrics()["restarts"] == 2
    assert searcher.strategy.search.grammar.productions == grammar.productions


def test_each_roll_out_has_a_scenario_of_its_own(search):
    _, proposals = search(120, preset="paper", batch=4)
    assert [proposal.start for proposal in proposals] == list(range(120))
    assert all(proposal.stop == proposal.start + 1 for proposal in proposals)


def test_any_order_is_brought_to_leftmost_order(grammar, context):
    rng = context().rng
    for _ in range(50):
        form, steps = grammar.start(), []
        while not grammar.is_word(form):
            position = int(rng.choice(grammar.positions(form)))
            production = int(rng.choice(grammar.legal(form, position)))
            steps.append((form, position, production))
            form = grammar.apply(form, production, position)
        derivation = leftmost(grammar, steps)
        assert grammar.tree(grammar.derive(derivation)) == grammar.tree(form)


def test_blocks_of_a_derivation_are_the_children_of_its_tree(grammar, context):
    rng = context().rng
    for _ in range(30):
        derivation = grammar.sample(rng)
        tree = grammar.tree(grammar.derive(derivation))
        parts = [grammar.tree(grammar.derive(own, block)) for block, own in block_derivations(grammar, derivation)]
        assert tuple(parts) == tree.children


def test_unset_c_is_one(context):
    assert PaperSearch(context(), DagMctsParameters(preset="paper")).search.bandit.c == 1.0
