"""Ways from a nonterminal back to itself: what can be put around a sub-tree without changing what it is."""

from __future__ import annotations

from typing import TypeAlias

from grammarbt.grammar import BoundGrammar
from grammarbt.search.derivations import Template

Loop: TypeAlias = tuple[Template, Template]
"""What stands before and behind the sub-tree, in leftmost order."""

LONGEST = 5
"""Productions on a way."""
MOST = 200
"""Ways from one nonterminal; the shortest are kept."""


class Loops:
    """The ways from each nonterminal back to itself that meet no other nonterminal twice.

    Args:
        grammar: the language.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self._known: dict[int, tuple[Loop, ...]] = {}

    def of(self, symbol: int) -> tuple[Loop, ...]:
        """Those of a nonterminal, the shortest first."""
        if symbol not in self._known:
            self._known[symbol] = tuple(self._ways(symbol))
        return self._known[symbol]

    def _ways(self, symbol: int) -> list[Loop]:
        """Breadth first."""
        found: list[Loop] = []
        ways: list[tuple[int, frozenset[int], Loop]] = [(symbol, frozenset(), ((), ()))]
        for _ in range(LONGEST):
            longer: list[tuple[int, frozenset[int], Loop]] = []
            for last, met, (before, behind) in ways:
                for production in self.grammar.by_lhs[last]:
                    parts = self.grammar.parts[production.number]
                    for at, part in enumerate(parts):
                        left = (*before, production.number, *((None,) * at))
                        loop = (left, ((None,) * (len(parts) - at - 1)) + behind)
                        if part == symbol:
                            found.append(loop)
                        elif part not in met:
                            longer.append((part, met | {part}, loop))
                    if len(found) >= MOST:
                        return found
            ways = longer[:MOST]
        return found
