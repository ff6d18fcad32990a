import pytest

from grammarbt.search import block_derivations, leftmost, position_of
from grammarbt_dagmcts.dag import Dag, ancestors
from grammarbt_dagmcts.paper import PaperSearch
from grammarbt_dagmcts.parameters import DagMctsParameters


@pytest.fixture
def grown(search):
    searcher, _ = search(200, preset="paper", restart_every=0)
    return searcher.strategy.search


def test_every_parent_in_the_dag_is_joined(grown, grammar):
    known = grown.dag.by_form
    for node in grown.dag.nodes:
        expected = {known[form].number for form, _ in grammar.parents(node.form) if form in known}
        assert {parent.number for parent in node.parents} == expected


def test_every_edge_is_one_production(grown, grammar):
    for node in grown.dag.nodes:
        for child, production in node.children.values():
            position = position_of(grammar, node.form, production, child.form)
            assert grammar.apply(node.form, production, position) == child.form


def test_some_nodes_have_several_parents(grown):
    assert max(len(node.parents) for node in grown.dag.nodes) > 1


def test_each_ancestor_is_credited_once_per_roll_out(context, answer):
    strategy = PaperSearch(context(), DagMctsParameters(preset="paper", restart_every=0))
    batches = strategy.batches(lambda: 1)
    proposals = next(batches)
    for _ in range(80):
        nodes = list(strategy.search.dag.nodes)
        before = [(node.visits, list(node.parents)) for node in nodes]
        proposals = batches.send([answer(proposal) for proposal in proposals])
        credited = {node.number for node, (visits, _) in zip(nodes, before, strict=True) if node.visits > visits}
        assert all(node.visits <= visits + 1 for node, (visits, _) in zip(nodes, before, strict=True))
        assert strategy.search.dag.root.number in credited
        for node, (_, parents) in zip(nodes, before, strict=True):
            assert node.number not in credited or credited >= {parent.number for parent in parents}


def descendant(grammar, steps):
    form = grammar.start()
    for _ in range(steps):
        form = grammar.apply(form, grammar.legal(form)[-1])
    return form


def test_linked_forms_lie_within_k_inverse_productions(grammar):
    dag = Dag(grammar)
    node = dag.add(descendant(grammar, 6))
    dag.link_ancestors(node, 6, 10_000)
    assert dag.root in ancestors([node])
    for other in dag.nodes:
        assert other is node or node.form in _below(grammar, other.form, 6)


def test_ancestors_further_than_k_stay_unlinked(grammar):
    dag = Dag(grammar)
    node = dag.add(descendant(grammar, 6))
    dag.link_ancestors(node, 3, 10_000)
    assert len(dag.nodes) == 2
    assert dag.root not in ancestors([node])


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
