"""The derivations of a language, smallest tree first."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import TypeAlias

from attrs import frozen

from grammarbt.grammar import Derivation
from grammarbt.search.leastsizes import ENDLESS
from grammarbt.search.states import State, States

_Chain: TypeAlias = "tuple[int, _Chain] | None"
"""Numbers, the last one first."""


def smallest_first(states: States) -> Iterator[Derivation]:
    """Every derivation, by the nodes of its tree; of equal ones, in the grammar's order. Ends with the language."""
    sizes = _Sizes(states)
    for size in count(1):
        yield from sizes.of(size)
        if not sizes.larger:
            return


@frozen(eq=False)
class _Partial:
    """A partial derivation: where it stands (None at the end), what waits, what was done, and its tree's fewest nodes."""

    state: State | None
    waiting: _Chain
    done: _Chain
    nodes: int


class _Sizes:
    """Walks through all derivations of one size at a time; `larger` says whether the last walk left any out."""

    def __init__(self, states: States) -> None:
        self.states = states
        self.larger = True
        self._least = self._least_nodes()
        self._extra = tuple(
            self._nodes(number) - self._least[production.lhs]
            for number, production in enumerate(states.grammar.productions)
        )

    def _least_nodes(self) -> dict[int, int]:
        """The fewest nodes that each nonterminal can become, constraints aside."""
        self._least = dict.fromkeys(self.states.grammar.by_lhs, ENDLESS)
        before: dict[int, int] = {}
        while self._least != before:
            before = dict(self._least)
            for production in self.states.grammar.productions:
                self._least[production.lhs] = min(self._least[production.lhs], self._nodes(production.number))
        return self._least

    def _nodes(self, production: int) -> int:
        """The fewest nodes of a tree that begins with the production."""
        symbols = self.states.grammar.productions[production].rhs
        own = sum(symbol in self.states.grammar.node_terminals for symbol in symbols)
        return own + sum(self._least[part] for part in self.states.parts[production])

    def of(self, size: int) -> Iterator[Derivation]:
        """The derivations of trees with so many nodes."""
        self.larger = False
        start = self.states.start
        pending = [_Partial(start, None, None, self._least[start.symbol])]
        while pending:
            partial = pending.pop()
            if partial.state is None:
                if partial.nodes == size:
                    yield _unchained(partial.done)
                continue
            for production in reversed(partial.state.productions):
                nodes = partial.nodes + self._extra[production]
                if nodes <= size:
                    pending.append(self._after(partial, partial.state, production, nodes))
                self.larger |= nodes > size

    def _after(self, partial: _Partial, state: State, production: int, nodes: int) -> _Partial:
        step = state.steps.get(production) or self.states.step(state, production)
        done = (production, partial.done)
        if step.down is not None:
            waiting = partial.waiting
            for symbol in step.waiting:
                waiting = (symbol, waiting)
            return _Partial(step.down, waiting, done, nodes)
        if partial.waiting is None:
            return _Partial(None, None, done, nodes)
        symbol, waiting = partial.waiting
        return _Partial(step.up.get(symbol) or self.states.up(step, symbol), waiting, done, nodes)


def _unchained(chain: _Chain) -> Derivation:
    found: list[int] = []
    while chain is not None:
        production, chain = chain
        found.append(production)
    return tuple(reversed(found))
