"""Can this still be finished? The reason why a derivation never dead-ends.

For every nonterminal we know the *minimal needs*: the smallest amounts of what scopes have in limited supply that some
finished derivation of it uses, as an antichain of vectors. A sentential form can be finished if its nonterminals' needs
add up, in some combination, to no more than its scopes have left. Leaves are counted by class, so the antichains are
small even when there are many leaves.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from operator import eq

from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError
from grammarbt.grammar.syntax import Limit, Unique
from grammarbt.grammar.table import Production, ProductionTable
from grammarbt.grammar.vectors import NOTHING, Antichain, Vector, add, minimal, undercut

ENDLESS = 1_000_000
MAX_VECTORS = 2_500
MAX_STEPS = 50_000
"""How many sums may be tried for one question; all nonterminals' needs together may take five times as many."""


class EntangledError(GrammarFileError):
    """The constraints depend on each other in more ways than can be looked through; shown at the first of them.

    Args:
        grammar: whose constraints.
        unfinished: what was to be finished, for people; empty when it is any tree at all.
    """

    def __init__(self, grammar: ProductionTable, unfinished: str = "") -> None:
        directives: tuple[Unique | Limit, ...] = (*grammar.grammar.uniques, *grammar.grammar.limits)
        message = "the constraints are too entangled to tell what can be finished"
        help_ = "let %unique count less, give its scope fewer rules, or bind to fewer groups"
        notes = (f"to be finished: {unfinished}",) if unfinished else ()
        super().__init__([Diagnostic("G406", message, directives[0].span if directives else None, help_, notes)])


class Needs:
    """Minimal needs of every nonterminal at every remaining depth, and sums of them."""

    def __init__(self, grammar: ProductionTable, *, unlimited: bool = False) -> None:
        self.grammar = grammar
        self.capacity = [ENDLESS if unlimited else dimension.capacity for dimension in grammar.costs.dimensions]
        self.constraint_of = [dimension.constraint for dimension in grammar.costs.dimensions]
        self.production_cost = [self._cost(production) for production in grammar.productions]
        self.table: dict[tuple[int, int], Antichain] = {}
        self.steps = 0
        self.users = _users(grammar.productions)
        limits = [grammar.costs.constraints[at].most for at in grammar.depth_constraints]
        self.deepest = self._fill_depths(max(limits, default=-1))
        self._fill(ENDLESS)

    def of(self, nonterminal: int, remaining: int = ENDLESS) -> Antichain:
        """What a derivation of the nonterminal needs at least of the scopes around it; empty if it has none."""
        return self.table.get((nonterminal, remaining if remaining == ENDLESS else min(remaining, self.deepest)), ())

    def inside(self, nonterminal: int, remaining: int) -> int:
        """The depth that remains within a use of the nonterminal, when `remaining` remains around it."""
        constraints = self.grammar.costs.constraints
        own = [constraints[at].most for at in self.grammar.opens_of(nonterminal) if constraints[at].kind == "depth"]
        return min([remaining, *own])

    def _cost(self, production: Production) -> Vector:
        if not any(production.use):
            return ()
        found = []
        for at, dimension in enumerate(self.grammar.costs.dimensions):
            use = production.use[dimension.constraint]
            amount = (use & dimension.mask).bit_count() if dimension.mask else use
            if amount:
                found.append((at, amount))
        return tuple(found)

    def _fill_depths(self, limit: int) -> int:
        """Fill depth after depth until more depth makes no difference; gives the last depth filled."""
        reach = 1 + max((level for production in self.grammar.productions for level in production.levels), default=0)
        nonterminals = tuple(self.grammar.by_lhs)
        same = 0
        for remaining in range(limit + 1):
            self.deepest = remaining
            self._fill(remaining)
            before = (self.table.get((symbol, remaining - 1)) for symbol in nonterminals)
            after = (self.table.get((symbol, remaining)) for symbol in nonterminals)
            same = same + 1 if all(map(eq, before, after)) and remaining > reach else 0
            if same > reach:
                return remaining
        return limit

    def _fill(self, remaining: int) -> None:
        """Fixpoint over all productions for one remaining depth; those met last use the fewest others."""
        queue = deque(reversed(self.grammar.productions))
        waiting = {production.number for production in queue}
        while queue:
            production = queue.popleft()
            waiting.discard(production.number)
            if self._improve(production, remaining):
                for user in self.users.get(production.lhs, ()):
                    if user.number not in waiting:
                        waiting.add(user.number)
                        queue.append(user)
            if self.steps > 5 * MAX_STEPS:
                raise EntangledError(self.grammar)

    def _improve(self, production: Production, remaining: int) -> bool:
        key = (production.lhs, remaining)
        old = self.table.get(key, ())
        if old == NOTHING:
            return False
        more = self._production_needs(production, remaining, old)
        new = minimal((*old, *more)) if more else old
        if new == old:
            return False
        self.table[key] = new
        return True

    def _production_needs(self, production: Production, remaining: int, known: Antichain) -> Antichain:
        parts = self.parts(production, remaining)
        around = self.grammar.encloses_of(production.lhs)
        if parts is None or self.clashes(production, around):
            return ()
        return self.total(parts, self.production_cost[production.number], {}, around, known)

    def allows(self, production: Production) -> bool:
        """Whether the production fits into fresh scopes."""
        around = self.grammar.encloses_of(production.lhs)
        parts = None if self.clashes(production, around) else self.parts(production, ENDLESS)
        return parts is not None and bool(self.total(parts, self.production_cost[production.number], {}, ()))

    def demands(self, production: Production) -> Antichain:
        """The production's minimal needs, those of scopes that its left-hand side opens included; empty if unusable."""
        parts = self.parts(production, ENDLESS)
        seen = {*self.grammar.encloses_of(production.lhs), *self.grammar.opens_of(production.lhs)}
        if parts is None or self.clashes(production, seen):
            return ()
        return self.total(parts, self.production_cost[production.number], {}, seen)

    def is_free(self, production: Production, position: int, limiting: frozenset[int]) -> bool:
        """Whether the production can use up nothing of these constraints, but for the symbol at a position."""
        siblings = (symbol for at, symbol in enumerate(production.rhs) if at != position)
        choices = [self.of(symbol) for symbol in siblings if self.grammar.is_nonterminal(symbol)]
        deeper = production.levels[position] and not limiting.isdisjoint(self.grammar.depth_constraints)
        return not deeper and all(
            any(all(self.constraint_of[dimension] not in limiting for dimension, _ in vector) for vector in vectors)
            for vectors in [(self.production_cost[production.number],), *choices]
        )

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

    def total(
        self,
        parts: Sequence[Antichain],
        base: Vector,
        left: dict[int, int],
        around: Iterable[int],
        known: Antichain = (),
    ) -> Antichain:
        """Minimal sums of one vector per part plus `base`, within what is left, seen from the scopes around.

        `left` overrides a dimension's capacity; sums that a `known` vector undercuts are left out. When nothing is
        seen from around, the first sum found will do.

        Raises:
            EntangledError: there are too many sums.
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
        for part in sorted(parts, key=len):
            sums = self._sums(sums, part, left, lambda one: undercut(self._project(one, seen), known))
        return minimal(self._project(vector, seen) for vector in sums)

    def _sums(
        self, sums: Antichain, part: Antichain, left: dict[int, int], superfluous: Callable[[Vector], bool]
    ) -> Antichain:
        self.steps += len(sums) * len(part)
        if len(sums) * len(part) > MAX_STEPS:
            raise EntangledError(self.grammar)
        fitting = (added for one in sums for other in part if self._fits(added := add(one, other), left))
        found = minimal(added for added in fitting if not superfluous(added))
        if len(found) > MAX_VECTORS:
            raise EntangledError(self.grammar)
        return found

    def _some(self, parts: Sequence[Antichain], base: Vector, left: dict[int, int]) -> bool:
        """Whether some sum fits: depth-first, remembering what failed."""
        failed: set[tuple[int, Vector]] = set()
        stack = [(0, base)]
        while stack:
            at, vector = stack.pop()
            if at == len(parts):
                self.steps += len(failed)
                return True
            if len(failed) > MAX_STEPS:
                raise EntangledError(self.grammar)
            for other in reversed(parts[at]):
                step = (at + 1, add(vector, other))
                if step not in failed and self._fits(step[1], left):
                    failed.add(step)
                    stack.append(step)
        self.steps += len(failed)
        return False

    def _fits(self, vector: Vector, left: dict[int, int]) -> bool:
        return all(amount <= left.get(dimension, self.capacity[dimension]) for dimension, amount in vector)

    def _project(self, vector: Vector, seen: frozenset[int]) -> Vector:
        return tuple(pair for pair in vector if self.constraint_of[pair[0]] in seen)


def depth_below(remaining: int, level: int) -> int:
    """The depth that remains `level` parentheses further in."""
    return remaining if remaining == ENDLESS else max(remaining - level, 0)


def _users(productions: Sequence[Production]) -> dict[int, list[Production]]:
    found: dict[int, list[Production]] = {}
    for production in productions:
        for symbol in dict.fromkeys(production.rhs):
            found.setdefault(symbol, []).append(production)
    return found
