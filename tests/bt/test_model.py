"""Taking trees apart."""

from hypothesis import given
from hypothesis import strategies as st

from grammarbt.bt import Not, children, leaves, numbered, parse, rebuild, walk, with_children, without


def below(tree, gone):
    """The given places and all below them."""
    found = set()
    for place, (_, parent) in enumerate(numbered(tree)):
        if place in gone or parent in found:
            found.add(place)
    return found


@given(data=st.data())
def test_what_is_taken_out_is_gone_and_nothing_else(data, any_trees):
    tree = data.draw(any_trees)
    nodes = numbered(tree)
    gone = data.draw(st.sets(st.integers(0, len(nodes) - 1), max_size=3))
    hidden = below(tree, gone)
    left = tuple(node for place, (node, _) in enumerate(nodes) if place not in hidden and not children(node))
    rest = without(tree, gone)
    assert (leaves(rest) if rest else ()) == left


def test_a_control_node_left_empty_goes_too():
    tree = parse("?( →( !(a) ) ‖2( [b] [c] [d] ) )")
    assert without(tree, {3}) == parse("?( ‖2( [b] [c] [d] ) )")
    assert without(tree, {5, 6}) == parse("?( →( !(a) ) ‖1( [d] ) )")
    assert without(tree, {1, 4}) is None
    assert without(tree, ()) == tree


@given(data=st.data())
def test_a_node_with_its_own_children_is_itself(data, any_trees):
    tree = data.draw(any_trees)
    assert all(with_children(node, children(node)) == node for node in walk(tree))
    assert rebuild(tree, lambda node: node) == tree


def test_every_node_knows_its_parent():
    tree = parse("?( →( (a) !([b]) ) [c] )")
    nodes = numbered(tree)
    assert [node for node, _ in nodes] == list(walk(tree))
    assert [parent for _, parent in nodes] == [None, 0, 1, 1, 3, 0]
    assert isinstance(nodes[3][0], Not)
