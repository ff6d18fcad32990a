"""Can this still be finished? The reason why a derivation never dead-ends.

For every nonterminal we know the *minimal needs*: the smallest amounts of what scopes have in limited supply that some
finished derivation of it uses, as an antichain of vectors. A sentential form can be finished if its nonterminals' needs
add up, in some combination, to no more than its scopes have left. Leaves are counted by class, so the antichains are
small even when there are many leaves.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

from grammarbt.grammar.table import Production, ProductionTable

Vector: TypeAlias = tuple[tuple[int, int], ...]
"""(dimension, amount) pairs in order of dimension; amounts are above 0."""

Antichain: TypeAlias = tuple[Vector, ...]
NOTHING: Antichain = ((),)
ENDLESS = 1_000_000
MAX_VECTORS = 5_000


class Needs:
    """Minimal needs of every nonterminal at every remaining depth, and sums of them."""

    def __init__(self, grammar: ProductionTable) -> None:
        self.grammar = grammar
        self.capacity = [dimension.capacity for dimension in grammar.costs.dimensions]
        self.constraint_of = [dimension.constraint for dimension in grammar.costs.dimensions]
        self.production_cost = [self._cost(production) for production in grammar.productions]
        self.table: dict[tuple[int, int], Antichain] = {}
        limits = [grammar.costs.constraints[at].most for at in grammar.depth_constraints]
        for remaining in [*range(max(limits, default=-1) + 1), ENDLESS]:
            self._fill(remaining)

    def of(self, nonterminal: int, remaining: int = ENDLESS) -> Antichain:
        """What a derivation of the nonterminal needs at least of the scopes around it; empty if it has none."""
        return self.table.get((nonterminal, remaining), ())

    def inside(self, nonterminal: int, remaining: int) -> int:
        """The depth that remains within a use of the nonterminal, when `remaining` remains around it."""
        constraints = self.grammar.costs.constraints
        own = [constraints[at].most for at in self.grammar.opens_of(nonterminal) if constraints[at].kind == "depth"]
        return min([remaining, *own])

    def _cost(self, production: Production) -> Vector:
        found = []
        for at, dimension in enumerate(self.grammar.costs.dimensions):
            use = production.use[dimension.constraint]
            amount = (use & dimension.mask).bit_count() if dimension.mask else use
            if amount:
                found.append((at, amount))
        return tuple(found)

    def _fill(self, remaining: int) -> None:
        """Fixpoint over all productions for one remaining depth."""
        users: dict[int, list[Production]] = {}
        for production in self.grammar.productions:
            for symbol in dict.fromkeys(production.rhs):
                users.setdefault(symbol, []).append(production)
        queue = list(self.grammar.productions)
        waiting = {production.number for production in queue}
        while queue:
            production = queue.pop()
            waiting.discard(production.number)
            if self._improve(production, remaining):
                for user in users.get(production.lhs, []):
                    if user.number not in waiting:
                        waiting.add(user.number)
                        queue.append(user)

    def _improve(self, production: Production, remaining: int) -> bool:
        key = (production.lhs, remaining)
        old = self.table.get(key, ())
        if old == NOTHING:
            return False
        new = minimal((*old, *self._production_needs(production, remaining)))
        if new == old:
            return False
        self.table[key] = new
        return True

    def _production_needs(self, production: Production, remaining: int) -> Antichain:
        parts = self.parts(production, remaining)
        around = self.grammar.encloses_of(production.lhs)
        if parts is None or self.clashes(production, around):
            return ()
        return self.total(parts, self.production_cost[production.number], {}, around)

    def clashes(self, production: Production, around: Iterable[int]) -> bool:
        """Whether the production breaks, by itself, a constraint on a scope that is or may be open."""
        scopes = {*around, *self.grammar.opens_of(production.lhs)}
        return any(at in scopes for at in production.clash)

    def parts(self, production: Production, remaining: int) -> list[Antichain] | None:
        """The needs of the symbols on the right; None if some cannot be finished at that depth."""
        left = self.inside(production.lhs, remaining)
        found = []
        for symbol, level in zip(production.rhs, production.levels, strict=True):
            if self.grammar.is_nonterminal(symbol):
                needs = self.of(symbol, depth_below(left, level))
                if not needs:
                    return None
                if needs != NOTHING:
                    found.append(needs)
            elif depth_below(left, level) < 1 and symbol in self.grammar.node_terminals:
                return None
        return found

    def total(self, parts: Sequence[Antichain], base: Vector, left: dict[int, int], around: Iterable[int]) -> Antichain:
        """Minimal sums of one vector per part plus `base`, within what is left, seen from the scopes around.

        `left` overrides a dimension's capacity. When nothing is seen from around, the first sum found will do.
        """
        seen = frozenset(around)
        if not self._fits(base, left):
            return ()
        if not any(
            self.constraint_of[dimension] in seen for part in parts for vector in part for dimension, _ in vector
        ):
            shown = self._project(base, seen)
            return (shown,) if self._some(sorted(parts, key=len), base, left) else ()
        sums: Antichain = (base,)
        for part in parts:
            sums = minimal(added for one in sums for other in part if self._fits(added := _add(one, other), left))[
                :MAX_VECTORS
            ]
        return minimal(self._project(vector, seen) for vector in sums)

    def _some(self, parts: Sequence[Antichain], base: Vector, left: dict[int, int]) -> bool:
        """Whether some sum fits: depth-first, remembering what failed."""
        failed: set[tuple[int, Vector]] = set()
        stack = [(0, base)]
        while stack:
            at, vector = stack.pop()
            if at == len(parts):
                return True
            for other in reversed(parts[at]):
                step = (at + 1, _add(vector, other))
                if step not in failed and self._fits(step[1], left):
                    failed.add(step)
                    stack.append(step)
        return False

    def _fits(self, vector: Vector, left: dict[int, int]) -> bool:
        return all(amount <= left.get(dimension, self.capacity[dimension]) for dimension, amount in vector)

    def _project(self, vector: Vector, seen: frozenset[int]) -> Vector:
        return tuple(pair for pair in vector if self.constraint_of[pair[0]] in seen)


def depth_below(remaining: int, level: int) -> int:
    """The depth that remains `level` parentheses further in."""
    return remaining if remaining == ENDLESS else max(remaining - level, 0)


def minimal(vectors: Iterable[Vector]) -> Antichain:
    """The vectors that no other one undercuts, in a fixed order."""
    found: list[Vector] = []
    for vector in sorted(set(vectors), key=lambda v: (sum(amount for _, amount in v), v)):
        if not any(_at_most(other, vector) for other in found):
            found.append(vector)
    return tuple(found)


def _at_most(one: Vector, other: Vector) -> bool:
    amounts = dict(other)
    return all(amount <= amounts.get(dimension, 0) for dimension, amount in one)


def _add(one: Vector, other: Vector) -> Vector:
    if not one or not other:
        return one or other
    amounts = dict(one)
    for dimension, amount in other:
        amounts[dimension] = amounts.get(dimension, 0) + amount
    return tuple(sorted(amounts.items()))
