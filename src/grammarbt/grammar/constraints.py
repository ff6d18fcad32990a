"""`%unique` and `%limit`, compiled to bit masks and counters.

A *scope* is what one use of a constrained rule derives. While a scope is open, a sentential form remembers for it which
leaves and groups are used (a bit each) and how many nodes are there. For asking what can still be finished, leaves that
the grammar cannot tell apart are counted together as a *class*.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, TypeAlias

from attrs import frozen

from grammarbt.bt.model import Action, Condition
from grammarbt.bt.notation import OperatorToken
from grammarbt.grammar.model import Grammar
from grammarbt.grammar.symbols import PlainProduction

Kind: TypeAlias = Literal["unique", "nodes", "depth"]


@frozen
class Dimension:
    """Something a scope has a limited amount of: leaves of a class, groups of a class, or nodes.

    Attributes:
        constraint: which constraint limits it.
        mask: the bits counted together; 0 for nodes.
        capacity: how many there are.
    """

    constraint: int
    mask: int
    capacity: int


@frozen
class Constraint:
    """One constraint, on every scope of a rule; `most` is the limit, 1 for uniqueness."""

    kind: Kind
    rule: str
    most: int


@frozen
class Costs:
    """What each production uses up.

    Attributes:
        constraints: all of them.
        dimensions: what their scopes have limited amounts of.
        use: per production and constraint: a bit mask (unique) or a number of nodes.
        clash: productions that use the same thing twice by themselves, with the constraint.
    """

    constraints: tuple[Constraint, ...]
    dimensions: tuple[Dimension, ...]
    use: tuple[tuple[int, ...], ...]
    clash: frozenset[tuple[int, int]]


def compile_costs(grammar: Grammar, productions: Sequence[PlainProduction]) -> Costs:
    """Number what the constraints count, and say what each production uses of it."""
    constraints = _constraints(grammar)
    items = [_items(grammar, names, productions) for names in _counted(grammar)]
    bits = [_bits(own) for own in items]
    use, clash = [], set()
    for number, production in enumerate(productions):
        row = []
        for at, constraint in enumerate(constraints):
            if constraint.kind == "unique":
                own = items[at][number]
                row.append(sum({1 << bits[at][item] for item in own}))
                if len(set(own)) < len(own):
                    clash.add((number, at))
            else:
                row.append(_nodes(production) if constraint.kind == "nodes" else 0)
        use.append(tuple(row))
    dimensions = _dimensions(constraints, items, bits, productions)
    return Costs(constraints, dimensions, tuple(use), frozenset(clash))


def _counted(grammar: Grammar) -> list[tuple[str, ...]]:
    return [unique.names for unique in grammar.uniques] + [()] * len(grammar.limits)


def _constraints(grammar: Grammar) -> tuple[Constraint, ...]:
    uniques = [Constraint("unique", unique.scope, 1) for unique in grammar.uniques]
    limits = [
        Constraint("nodes" if limit.kind == "nodes" else "depth", limit.scope, limit.most) for limit in grammar.limits
    ]
    return (*uniques, *limits)


def _items(
    grammar: Grammar, names: tuple[str, ...], productions: Sequence[PlainProduction]
) -> list[tuple[object, ...]]:
    """Per production, the leaves and (variable, group) pairs that the names count."""
    kinds = {"ACTION": Action, "CONDITION": Condition}
    types: tuple[type, ...] = tuple(kinds[name] for name in names if name in kinds)
    variables = {name for name in names if name in grammar.variables}
    found: list[tuple[object, ...]] = []
    for production in productions:
        leaves = [symbol for symbol in production.rhs if isinstance(symbol, types)]
        pairs = [pair for pair in production.choices if pair[0] in variables]
        found.append((*leaves, *pairs))
    return found


def _bits(items: list[tuple[object, ...]]) -> dict[object, int]:
    """A bit for each thing counted, in the order met."""
    order = dict.fromkeys(item for own in items for item in own)
    return {item: bit for bit, item in enumerate(order)}


def _nodes(production: PlainProduction) -> int:
    return sum(isinstance(symbol, OperatorToken | Action | Condition) for symbol in production.rhs)


def _dimensions(
    constraints: tuple[Constraint, ...],
    items: list[list[tuple[object, ...]]],
    bits: list[dict[object, int]],
    productions: Sequence[PlainProduction],
) -> tuple[Dimension, ...]:
    found = []
    for at, constraint in enumerate(constraints):
        if constraint.kind == "nodes":
            found.append(Dimension(at, 0, constraint.most))
        elif constraint.kind == "unique":
            classes = _classes(items[at], bits[at], productions)
            found += [Dimension(at, mask, mask.bit_count()) for mask in classes]
    return tuple(found)


def _classes(
    items: list[tuple[object, ...]], bits: Mapping[object, int], productions: Sequence[PlainProduction]
) -> list[int]:
    """Masks of things that the grammar cannot tell apart.

    Two leaves are alike when they come up in the same left-hand sides, each time alone and in nothing but a bare
    production; everything else is a class of its own.
    """
    seen: dict[object, list[object]] = {item: [] for item in bits}
    for production, own in zip(productions, items, strict=True):
        bare = len(production.rhs) == 1 and len(own) == 1 and not production.choices
        for item in own:
            seen[item].append(production.lhs if bare else (production.lhs, item))
    masks: dict[tuple[object, ...], int] = {}
    for item, signature in seen.items():
        masks[tuple(signature)] = masks.get(tuple(signature), 0) | 1 << bits[item]
    return list(masks.values())
