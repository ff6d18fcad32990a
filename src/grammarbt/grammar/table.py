"""A grammar bound to a vocabulary, as data: numbered symbols and productions.

Terminals are numbered from 0, nonterminals after them. A sentential form also holds markers, negative numbers that
nobody sees in its text: where a scope of a constraint opens (one number per nonterminal that opens one) and closes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from hashlib import blake2b
from typing import TypeAlias

from attrs import field, frozen

from grammarbt.bt.model import Action, Condition
from grammarbt.bt.notation import BracketToken, Token, format_leaf
from grammarbt.bt.vocabulary import Vocabulary
from grammarbt.grammar.constraints import Costs
from grammarbt.grammar.grouping import grouped
from grammarbt.grammar.model import Grammar

CLOSE = -1
"""The marker that closes the innermost open scope."""

Derivation: TypeAlias = tuple[int, ...]
"""Numbers of productions in the order of a leftmost derivation; one per derivation tree."""


@frozen
class Production:
    """`lhs → rhs` in symbol numbers.

    Attributes:
        number: its place in `ProductionTable.productions`.
        levels: how deep in the production's own parentheses each symbol of `rhs` stands.
        use: per constraint, what it uses up: a bit mask, or a number of nodes.
        clash: constraints under which it uses something twice by itself.
        base: for a production that stands for a finished sub-tree, its derivation; else empty.
    """

    number: int
    lhs: int
    rhs: tuple[int, ...]
    levels: tuple[int, ...]
    weight: float = 1.0
    alias: str | None = None
    use: tuple[int, ...] = ()
    clash: tuple[int, ...] = ()
    base: Derivation = ()


@frozen(slots=False, eq=False)  # slots=False: cached_property keeps its value in the instance's dict
class ProductionTable:
    """The symbols, productions and constraints of a grammar over a vocabulary.

    Attributes:
        grammar, vocabulary: what was bound.
        terminals: notation tokens; a terminal's number is its place.
        names: the nonterminals' names; a nonterminal's number is its place plus the number of terminals.
        rules: the rule each nonterminal comes from, empty for sets of leaves and parts of rules.
        productions: in the order written out.
        costs: the constraints.
        opens: per nonterminal, the constraints of which each use of it is a scope.
        encloses: per nonterminal, the constraints that may have a scope open around it.
        blocks: the nonterminals of sub-trees that searchers treat as units.
    """

    grammar: Grammar = field(repr=False)
    vocabulary: Vocabulary = field(repr=False)
    terminals: tuple[Token, ...] = field(repr=False)
    names: tuple[str, ...] = field(repr=False)
    rules: tuple[str, ...] = field(repr=False)
    productions: tuple[Production, ...] = field(repr=False)
    costs: Costs = field(repr=False)
    opens: tuple[tuple[int, ...], ...] = field(repr=False)
    encloses: tuple[frozenset[int], ...] = field(repr=False)
    blocks: tuple[int, ...] = ()

    @cached_property
    def by_lhs(self) -> Mapping[int, tuple[Production, ...]]:
        """Each nonterminal's productions."""
        return {lhs: tuple(own) for lhs, own in grouped(self.productions, lambda each: each.lhs).items()}

    @cached_property
    def parts(self) -> tuple[tuple[int, ...], ...]:
        """Per production, the nonterminals on its right, left to right."""
        return tuple(tuple(filter(self.is_nonterminal, production.rhs)) for production in self.productions)

    @cached_property
    def growth(self) -> tuple[int, ...]:
        """Per production, how many more nonterminals there are after it than before."""
        return tuple(len(parts) - 1 for parts in self.parts)

    @cached_property
    def start_symbol(self) -> int:
        """The number of the nonterminal that every tree begins with."""
        return len(self.terminals)

    @cached_property
    def fingerprint(self) -> str:
        """Tells this language apart from others; the same on every machine."""
        rows = [(p.lhs, p.rhs, repr(p.weight), p.alias) for p in self.productions]
        text = repr((self.token_texts, self.names, rows, self.costs.constraints))
        return blake2b(text.encode(), digest_size=12).hexdigest()

    @cached_property
    def token_texts(self) -> tuple[str, ...]:
        """Each terminal as it stands in the notation."""
        return tuple(map(token_text, self.terminals))

    @cached_property
    def brackets(self) -> tuple[int, int]:
        """Numbers of the opening and the closing parenthesis; -1 where the grammar has none."""
        number = {text: at for at, text in enumerate(self.token_texts)}
        return number.get("(", -1), number.get(")", -1)

    @cached_property
    def node_terminals(self) -> frozenset[int]:
        """Numbers of the terminals that stand for a node of the tree."""
        return frozenset(at for at, token in enumerate(self.terminals) if not isinstance(token, BracketToken))

    @cached_property
    def depth_constraints(self) -> frozenset[int]:
        """Numbers of the constraints on depth."""
        return frozenset(at for at, constraint in enumerate(self.costs.constraints) if constraint.kind == "depth")

    def is_nonterminal(self, symbol: int) -> bool:
        """Whether the number is a nonterminal's."""
        return symbol >= self.start_symbol

    def is_marker(self, symbol: int) -> bool:
        """Whether the number marks where a scope opens or closes."""
        return symbol < 0

    def opened_by(self, marker: int) -> int:
        """The nonterminal whose scope an opening marker opens."""
        return self.start_symbol - marker - 2

    def opening(self, nonterminal: int) -> int:
        """The marker that opens the nonterminal's scope."""
        return self.start_symbol - nonterminal - 2

    def opens_of(self, nonterminal: int) -> tuple[int, ...]:
        """The constraints of which a use of the nonterminal is a scope."""
        return self.opens[nonterminal - self.start_symbol]

    def encloses_of(self, nonterminal: int) -> frozenset[int]:
        """The constraints that may have a scope open around the nonterminal."""
        return self.encloses[nonterminal - self.start_symbol]

    def nonterminal_name(self, symbol: int) -> str:
        """As shown to people, for example `right{g1}`."""
        return self.names[symbol - self.start_symbol]

    def symbol_text(self, symbol: int) -> str:
        """A terminal's notation or a nonterminal's name."""
        return self.nonterminal_name(symbol) if self.is_nonterminal(symbol) else self.token_texts[symbol]

    def production_text(self, number: int) -> str:
        """`lhs → rhs`, for people."""
        production = self.productions[number]
        right = " ".join(map(self.symbol_text, production.rhs)) or "nothing"
        return f"{self.nonterminal_name(production.lhs)} ⇒ {right}"


def token_text(token: Token) -> str:
    """A token as it stands in the notation."""
    return format_leaf(token) if isinstance(token, Action | Condition) else token.sign


def enclosing(
    productions: Iterable[Production], opens: Mapping[int, tuple[int, ...]], start: int
) -> dict[int, frozenset[int]]:
    """For each nonterminal, the constraints that may have a scope open around it, found by a walk from the start."""
    by_lhs = grouped(productions, lambda production: production.lhs)
    found: dict[int, frozenset[int]] = {start: frozenset()}
    queue = [start]
    while queue:
        lhs = queue.pop()
        inside = found[lhs] | set(opens[lhs])
        for production in by_lhs.get(lhs, []):
            for symbol in production.rhs:
                if symbol < start or (symbol in found and inside <= found[symbol]):
                    continue
                found[symbol] = found.get(symbol, frozenset()) | inside
                queue.append(symbol)
    return found
