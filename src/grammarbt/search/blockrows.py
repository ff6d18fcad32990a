"""Which rows of blocks a language has, and how each is derived."""

from __future__ import annotations

from typing import TypeAlias

from grammarbt.grammar import BoundGrammar, SententialForm
from grammarbt.search.derivations import Template

Row: TypeAlias = tuple[int, ...]
"""Blocks, left to right."""

_Turn: TypeAlias = tuple[int, Row, SententialForm, int]
"""A production, the blocks that it leaves to the left of all else, what is still to rewrite, and the nonterminals therein."""


class BlockRows:
    """Rewrites what is not a block, from left to right.

    A state is a form without all that is to the left of the first nonterminal that is no block. What a block uses of what
    is limited is not known before it is derived, and not counted.

    Args:
        grammar: the language.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self._templates: dict[Row, Template | None] = {}
        self._turns: dict[SententialForm, list[_Turn]] = {}

    def template(self, row: Row) -> Template | None:
        """The derivation of a row of blocks; None if the language has no such row."""
        if row not in self._templates:
            self._templates[row] = self._derived(row)
        return self._templates[row]

    def _derived(self, row: Row) -> Template | None:
        """Found depth first."""
        blocks, state = self._without_blocks(self.grammar.start())
        pending: list[tuple[SententialForm, int, Template]] = []
        if row[: len(blocks)] == blocks:
            pending.append((state, len(blocks), (None,) * len(blocks)))
        seen: set[tuple[SententialForm, int]] = set()
        while pending:
            state, at, template = pending.pop()
            if not state.symbols:
                return template
            for production, blocks, after, left in self._following(state):
                end = at + len(blocks)
                fits = end + left <= len(row) if left else end == len(row)
                if fits and row[at:end] == blocks and (after, end) not in seen:
                    seen.add((after, end))
                    pending.append((after, end, (*template, production, *((None,) * len(blocks)))))
        return None

    def _following(self, state: SententialForm) -> list[_Turn]:
        turns = self._turns.get(state)
        if turns is None:
            turns = self._turns[state] = []
            for move in self.grammar.leftmost.moves(state):
                blocks, after = self._without_blocks(move.after)
                turns.append((move.production, blocks, after, len(self.grammar.positions(after))))
        return turns

    def _without_blocks(self, form: SententialForm) -> tuple[Row, SententialForm]:
        """The blocks to the left of any other nonterminal, and the state behind them."""
        blocks: list[int] = []
        while positions := self.grammar.positions(form):
            at = positions[0]
            if form.symbols[at] not in self.grammar.blocks:
                break
            blocks.append(form.symbols[at])
            rest = SententialForm((*form.symbols[:at], *form.symbols[at + 1 :]), form.used)
            form = self.grammar.leftmost.split(rest)[1]
        return tuple(blocks), form
