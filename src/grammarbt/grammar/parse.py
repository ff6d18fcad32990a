"""Is this tree in the language? Its derivation, or the place where it leaves the language.

A depth-first walk along the leftmost states, trying productions in the grammar's order and remembering what failed; the
first derivation found is the first in that order. A state is given up as soon as it holds more or fewer trees than the
tree still has between the parentheses open there, so guessing where a list of children ends costs nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from heapq import heappop, heappush
from typing import TypeAlias

from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, children
from grammarbt.bt.notation import BracketToken, OperatorToken, Token, operator
from grammarbt.errors import GrammarError
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.leftmost import Word
from grammarbt.grammar.lookahead import CLOSED, OPEN, Lookahead
from grammarbt.grammar.table import Derivation, token_text

MAX_STEPS = 100_000
"""States looked at, at most, for one tree."""

MAX_BLIND_STEPS = 5_000
"""States looked at, at most, to say what would have been possible."""

MAX_SHOWN = 8
"""Alternatives named in a message."""


class NotInLanguageError(GrammarError):
    """A tree is not in the language.

    Args:
        row: the tree's tokens.
        place: which of them cannot stand where it stands; `len(row)` if the tree should go on.
        possible: what could stand there instead.
    """

    def __init__(self, row: tuple[Token, ...], place: int, possible: tuple[str, ...]) -> None:
        self.row, self.place, self.possible = row, place, possible
        super().__init__(self._message(), self._hint())

    @property
    def found(self) -> str:
        """The token that cannot stand there."""
        return token_text(self.row[self.place]) if self.place < len(self.row) else "the end"

    @property
    def before(self) -> str:
        """The tree up to that place."""
        return row_text(self.row[: self.place])

    @property
    def closest(self) -> str | None:
        """What could stand there and looks most like what does."""
        same = [text for text in self.possible if text[0] == self.found[0]]
        return next(iter([*get_close_matches(self.found, same, 1, 0.3), *same, *self.possible]), None)

    def _message(self) -> str:
        after = f"after {_tail(self.before)!r}" if self.place else "at the beginning"
        return f"the tree leaves the language at {self.found!r}, node {_node_number(self.row, self.place)}, {after}"

    def _hint(self) -> str:
        if not self.possible:
            return "nothing could follow there"
        shown = ", ".join(self.possible[:MAX_SHOWN]) + (", …" if len(self.possible) > MAX_SHOWN else "")
        return f"closest: {self.closest}; possible there: {shown}"


def parse_tree(bound: BoundGrammar, tree: BehaviorTree, symbol: int | None = None) -> Derivation:
    """The first derivation of a tree, in the order of the grammar's productions.

    Args:
        bound: the language.
        tree: any tree.
        symbol: the nonterminal to derive it from; the start symbol unless given.

    Raises:
        NotInLanguageError: it has none; says where it leaves the language.
        GrammarError: the grammar is so ambiguous that `MAX_STEPS` states did not suffice.
    """
    row = tree_tokens(tree)
    search = _Search(bound, row)
    derivation = search.derivation(bound.start(symbol))
    if derivation is None:
        place, possible = search.furthest()
        raise NotInLanguageError(row, place, tuple(map(bound.symbol_text, possible)))
    return derivation


def tree_tokens(tree: BehaviorTree) -> tuple[Token, ...]:
    """The tree as a row of tokens; every operator has its parentheses."""
    found: list[Token] = []
    stack: list[Node | BracketToken] = [tree]
    while stack:
        node = stack.pop()
        if isinstance(node, BracketToken | Action | Condition):
            found.append(node)
        else:
            found += [OperatorToken(operator(node)), OPEN]
            stack += [CLOSED, *reversed(children(node))]
    return tuple(found)


def row_text(row: tuple[Token, ...]) -> str:
    """A row of tokens, which need not be a whole tree, in the notation."""
    parts = [token_text(token) if token == OPEN else f" {token_text(token)}" for token in row]
    return "".join(parts).strip()


_Configuration: TypeAlias = tuple[int, SententialForm]
"""How many tokens are read, and what is still to be derived."""


class _Search:
    """Depth-first for a derivation; best-first for the place where there is none."""

    def __init__(self, bound: BoundGrammar, row: tuple[Token, ...]) -> None:
        number = {token: at for at, token in enumerate(bound.terminals)}
        self.leftmost = bound.leftmost
        self.numbers = [number.get(token, -1) for token in row]
        self.lookahead = Lookahead(bound, row)
        self.possible: dict[int, dict[int, None]] = {}
        self.refused: list[_Configuration] = []

    def derivation(self, start: SententialForm) -> Derivation | None:
        """The first derivation, if there is one."""
        trail: list[int] = []
        stack, seen = [self._moves((0, start))], {(0, start)}
        while stack:
            production, after = next(stack[-1], (-1, None))
            if after is None:
                stack.pop()
                del trail[-1:]
            elif after not in seen:
                seen.add(after)  # whoever comes here again comes in vain: the first visit looks at everything
                if not self.lookahead.fits(*after):
                    self.refused.append(after)
                    continue
                trail.append(production)
                if not after[1].symbols:
                    return tuple(trail)
                stack.append(self._moves(after))
            if len(seen) > MAX_STEPS:
                raise GrammarError(f"no derivation found in {MAX_STEPS:,} steps", "make the grammar less ambiguous")
        return None

    def furthest(self) -> tuple[int, tuple[int, ...]]:
        """How far some derivation spells the tree, and which terminals could follow there.

        Goes on, for a while, where the search for a derivation gave up because a number of trees did not fit: people
        see the difference where the trees differ, not where a count first goes wrong.
        """
        queue: list[tuple[int, int, int, SententialForm]] = []
        seen = set(self.refused)
        for number, (read, state) in enumerate(self.refused):
            heappush(queue, (-read, len(state.symbols), number, state))
        for _ in range(MAX_BLIND_STEPS):
            if not queue:
                break
            left, _, _, state = heappop(queue)
            for _, after in self._moves((-left, state)):
                if after not in seen:
                    seen.add(after)
                    heappush(queue, (-after[0], len(after[1].symbols), len(seen), after[1]))
        place = max(self.possible, default=0)
        return place, tuple(self.possible.get(place, ()))

    def _moves(self, here: _Configuration) -> Iterator[tuple[int, _Configuration]]:
        read, state = here
        for move in self.leftmost.moves(state):
            at = self._read(read, move.emits)
            if at is not None and (move.after.symbols or at == len(self.numbers)):
                yield move.production, (at, move.after)

    def _read(self, at: int, emits: Word) -> int | None:
        """The place after the terminals, if the tree has the same ones; notes what would have been possible if not."""
        for terminal in emits:
            if at == len(self.numbers) or self.numbers[at] != terminal:
                self.possible.setdefault(at, {})[terminal] = None
                return None
            at += 1
        return at


def _tail(text: str, most: int = 60) -> str:
    return text if len(text) <= most else f"…{text[-most:]}"


def _node_number(row: tuple[Token, ...], place: int) -> int:
    """Which node of the tree stands there, counted from 1 in the order of the notation."""
    return sum(not isinstance(token, BracketToken) for token in row[: place + 1])
