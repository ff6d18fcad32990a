"""Leftmost derivations as a walk with a stack, fast enough for searchers that take millions of steps.

What may be done next depends on the next nonterminal, on what the open scopes have used up, and on how much the
nonterminals that wait in them need at least; not on their order. So there are far fewer *states* than sentential forms:
each is worked out once, by `grammar.leftmost`, and a step is then a look-up by production.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Container
from functools import cached_property
from itertools import accumulate

import numpy as np
from attrs import define, field

from grammarbt.bt import BehaviorTree
from grammarbt.bt.model import MAX_DEPTH, Node
from grammarbt.bt.notation import Token
from grammarbt.grammar import BoundGrammar, Derivation, SententialForm
from grammarbt.grammar.table import CLOSE
from grammarbt.grammar.vectors import NOTHING
from grammarbt.search.derivations import Template, end_of
from grammarbt.search.leastsizes import least_heights

MAX_STATES = 200_000


@define(eq=False)
class State:
    """A class of sentential forms whose next nonterminal, and all that is legal for it, are the same.

    Attributes:
        form: one of them, brought into order: what waits is sorted, and replaced by what needs as much.
        symbol: the next nonterminal.
        productions: the legal ones, in the grammar's order.
        bounds: running sums of their weights.
        steps: what each production leads to, once taken.
    """

    form: SententialForm
    symbol: int
    productions: tuple[int, ...]
    bounds: list[float] = field(repr=False)
    steps: dict[int, Transition] = field(factory=dict, init=False, repr=False)

    def draw(self, rng: np.random.Generator) -> int:
        """A legal production, by weight."""
        if len(self.productions) == 1:
            return self.productions[0]
        return self.productions[bisect_right(self.bounds, rng.random() * self.bounds[-1])]


@define(eq=False)
class Transition:
    """What a production does to a walk.

    Attributes:
        waiting: the production's nonterminals but the first, last one first; they wait on the stack.
        down: the state of the first of them; None if the production has none and the next comes from the stack.
        form: what is left when it comes from there.
        up: the state for each nonterminal that may come from there.
    """

    waiting: tuple[int, ...]
    down: State | None
    form: SententialForm
    up: dict[int, State] = field(factory=dict)


@define(eq=False)
class Walk:
    """A leftmost derivation on its way.

    Attributes:
        states: of the grammar.
        state: what may be done next; None when nothing is left to derive.
        stack: the nonterminals that wait, the last one first.
        derivation: the steps taken.
    """

    states: States
    state: State | None
    stack: list[int] = field(factory=list)
    derivation: list[int] = field(factory=list)

    def take(self, production: int) -> bool:
        """Take a step; False, and nothing done, if it is not legal."""
        state = self.state
        if state is None:
            return False
        step = state.steps.get(production)
        if step is None:
            if production not in state.productions:
                return False
            step = self.states.step(state, production)
        self.derivation.append(production)
        if step.down:
            self.stack += step.waiting
            self.state = step.down
        elif self.stack:
            symbol = self.stack.pop()
            self.state = step.up.get(symbol) or self.states.up(step, symbol)
        else:
            self.state = None
        return True

    def grow(self, rng: np.random.Generator, height: int = 0) -> None:
        """Derive at random, by weight, until no more than `height` nonterminals are left."""
        take, stack = self.take, self.stack
        while len(stack) >= height and (state := self.state):
            take(state.draw(rng))


class States:
    """The states of a grammar's leftmost derivations, made as they are met.

    Attributes:
        grammar: the language.
        parts: per production, the nonterminals on its right.
        start: the state before the first step.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.parts = grammar.parts
        self._known: dict[SententialForm, State] = {}
        self._backwards = tuple(production.rhs[::-1] for production in grammar.productions)
        needs = {symbol: grammar.forms.needs.of(symbol) for symbol in grammar.by_lhs}
        self._alike = {symbol: next(like for like in needs if needs[like] == own) for symbol, own in needs.items()}
        self._rows: dict[Derivation, tuple[Node, ...]] = {}
        self._most_open = max(production.rhs.count(grammar.brackets[0]) for production in grammar.productions)
        self._content = frozenset(symbol for symbol, own in needs.items() if own == NOTHING)
        self.start = self._state(grammar.start())

    @cached_property
    def heights(self) -> tuple[int, ...]:
        """Per production, the height of the lowest derivation tree that begins with it, constraints aside."""
        return least_heights(self.grammar)

    def walk(self) -> Walk:
        """A walk from the start symbol."""
        return Walk(self, self.start)

    def complete(self, template: Template, rng: np.random.Generator) -> Derivation | None:
        """The template with a random sub-tree, by weight, in each open place; None if a step is then not legal."""
        walk = self.walk()
        for production in template:
            if production is None:
                walk.grow(rng, len(walk.stack))
            elif not walk.take(production):
                return None
        return tuple(walk.derivation)

    def tree(self, derivation: Derivation) -> BehaviorTree:
        """The behavior tree that a whole derivation spells; equal sub-trees of blocks are made once.

        Raises:
            GrammarError: it is deeper than trees can be.
        """
        shallow = len(derivation) * self._most_open < MAX_DEPTH
        return self._row(derivation, self.grammar.blocks if shallow else ())[0]

    def _row(self, derivation: Derivation, blocks: Container[int]) -> tuple[Node, ...]:
        """What a derivation from any nonterminal spells; made once below the blocks."""
        terminals, backwards = self.grammar.terminals, self._backwards
        tokens: list[Token | Node] = []
        at, pending = 1, [*backwards[derivation[0]]]
        while pending:
            symbol = pending.pop()
            if symbol < self.grammar.start_symbol:
                tokens.append(terminals[symbol])
            elif symbol in blocks:
                end = end_of(self.grammar.growth, derivation, at)
                tokens += self._below_block(derivation[at:end])
                at = end
            else:
                pending += backwards[derivation[at]]
                at += 1
        return self.grammar.row_of(tokens)

    def _below_block(self, derivation: Derivation) -> tuple[Node, ...]:
        known = self._rows.get(derivation)
        if known is None:
            if len(self._rows) >= MAX_STATES:
                self._rows.clear()
            known = self._rows[derivation] = self._row(derivation, ())
        return known

    def step(self, state: State, production: int) -> Transition:
        """What a legal production does in a state."""
        form = self.grammar.leftmost.moves(state.form)[state.productions.index(production)].after
        parts = self.parts[production]
        step = state.steps[production] = Transition(parts[:0:-1], self._state(form) if parts else None, form)
        return step

    def up(self, step: Transition, symbol: int) -> State:
        """The state after a step that leaves nothing of its own, when the symbol comes next."""
        state = step.up[symbol] = self._state(self._forward(step.form, symbol))
        return state

    def _state(self, form: SententialForm) -> State:
        ordered = self._ordered(form)
        known = self._known.get(ordered)
        if known is None:
            if len(self._known) >= MAX_STATES:
                self._known.clear()
            productions = tuple(move.production for move in self.grammar.leftmost.moves(ordered))
            weights = (self.grammar.productions[production].weight for production in productions)
            symbol = ordered.symbols[self._first(ordered)]
            known = self._known[ordered] = State(ordered, symbol, productions, list(accumulate(weights)))
        return known

    def _ordered(self, form: SententialForm) -> SententialForm:
        """The form without terminals, in which what waits in each scope is sorted, and replaced by what needs as much.

        Where depth is limited, the place of each symbol matters; the form then stays as it is.
        """
        if self.grammar.depth_constraints:
            return form
        first = self._first(form)
        found = list(form.symbols[: first + 1])
        waiting: list[int] = []
        for symbol in form.symbols[first + 1 :]:
            if symbol == CLOSE:
                found += [*sorted(waiting), CLOSE]
                waiting = []
            elif self.grammar.is_nonterminal(symbol):
                waiting.append(self._alike[symbol])
        found += sorted(symbol for symbol in waiting if symbol not in self._content)
        return SententialForm(tuple(found), form.used)

    def _forward(self, form: SententialForm, symbol: int) -> SententialForm:
        """The form with a symbol that waits in its innermost scope, under its own or another's name, as the first."""
        if self.grammar.depth_constraints:
            return form
        first = self._first(form)
        rest = list(form.symbols[first:])
        if self._alike[symbol] in rest:
            rest.remove(self._alike[symbol])
        return SententialForm((*form.symbols[:first], symbol, *rest), form.used)

    def _first(self, form: SententialForm) -> int:
        """Where the first nonterminal stands, behind what opens the scopes around it."""
        return next((at for at, symbol in enumerate(form.symbols) if symbol >= self.grammar.start_symbol), 0)
