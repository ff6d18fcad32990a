"""A grammar bound to a vocabulary: the language of trees, and everything one can do with it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

import numpy as np
from attrs import evolve, frozen

from grammarbt.bt.model import MAX_DEPTH, BehaviorTree, Fallback, Node, Not, Parallel, Sequence
from grammarbt.bt.notation import BracketToken, OperatorToken, Token
from grammarbt.errors import GrammarError
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.leftmost import Leftmost, Word
from grammarbt.grammar.rewriting import Forms
from grammarbt.grammar.table import Derivation, Production, ProductionTable


@frozen(slots=False, eq=False)  # slots=False: cached_property keeps its value in the instance's dict
class BoundGrammar(ProductionTable):
    """The language of trees that a grammar spans over a vocabulary.

    A derivation never dead-ends: `legal` offers a production only if a word within all constraints can still be
    reached after it.
    """

    @cached_property
    def forms(self) -> Forms:
        """Operations on sentential forms."""
        return Forms(self)

    @cached_property
    def leftmost(self) -> Leftmost:
        """Leftmost derivations as states and moves."""
        return Leftmost(self, self.forms)

    def start(self, symbol: int | None = None) -> SententialForm:
        """The form that is only the start symbol, or only the given nonterminal."""
        return SententialForm((self.start_symbol if symbol is None else symbol,))

    def is_word(self, form: SententialForm) -> bool:
        """Whether nothing is left to derive."""
        return all(symbol < self.start_symbol for symbol in form.symbols)

    def positions(self, form: SententialForm) -> tuple[int, ...]:
        """Places of the form's nonterminals among its symbols, left to right."""
        return self.forms.positions(form)

    def legal(self, form: SententialForm, position: int | None = None) -> tuple[int, ...]:
        """Productions at a position (default: leftmost) after which a word can still be reached."""
        if position is None:
            return tuple(move.production for move in self.leftmost.moves(self.leftmost.split(form)[1]))
        return self.forms.legal(form, position)

    def apply(self, form: SententialForm, production: int, position: int | None = None) -> SententialForm:
        """The form after a production at a position (default: leftmost).

        Raises:
            GrammarError: the production does not belong there, or breaks a constraint.
        """
        at = self.positions(form)[0] if position is None else position
        rule = self.productions[production]
        after = self.forms.applied(form, rule, at) if form.symbols[at] == rule.lhs else None
        if after is None:
            place = self.symbol_text(form.symbols[at])
            raise GrammarError(f"{self.production_text(production)} cannot be applied at {place}", "ask legal() first")
        return after

    def parents(self, form: SententialForm) -> tuple[tuple[SententialForm, int], ...]:
        """Every form that becomes this one by one production, with its number, left to right."""
        return tuple(self.forms.parents(form))

    def text(self, form: SententialForm) -> str:
        """The form for people, without markers."""
        return " ".join(self.symbol_text(symbol) for symbol in form.symbols if symbol >= 0)

    def tree(self, form: SententialForm) -> BehaviorTree:
        """The behavior tree that a finished form spells; raises as `tree_of` does."""
        return self.tree_of(tuple(symbol for symbol in form.symbols if symbol >= 0))

    def tree_of(self, word: Word) -> BehaviorTree:
        """The behavior tree that a row of terminals spells.

        Raises:
            GrammarError: it is deeper than trees can be.
        """
        return self.row_of(map(self.terminals.__getitem__, word))[0]

    def row_of(self, tokens: Iterable[Token | Node]) -> tuple[Node, ...]:
        """The behavior trees that a row of tokens spells one after the other; some tokens may be sub-trees already.

        Raises:
            GrammarError: more parentheses are open at once than trees have levels.
        """
        stack: list[list[Node]] = [[]]
        signs: list[str] = []
        for token in tokens:
            if isinstance(token, OperatorToken):
                signs.append(token.sign)
            elif not isinstance(token, BracketToken):
                stack[-1].append(token)
            elif token.sign == "(":
                stack.append([])
                if len(stack) > MAX_DEPTH:
                    raise self._too_deep()
            else:
                children = tuple(stack.pop())
                stack[-1].append(_node(signs.pop(), children))
        return tuple(stack[0])

    def _too_deep(self) -> GrammarError:
        message = f"{self.grammar.source.name}: a tree is deeper than {MAX_DEPTH} levels"
        return GrammarError(message, f"add `%limit depth {MAX_DEPTH}`, or a smaller one")

    def sample(self, rng: np.random.Generator, symbol: int | None = None) -> Derivation:
        """A random derivation: at each step a legal production by weight."""
        return self.leftmost.random_walk(self.start(symbol), rng)[0]

    def derive(self, derivation: Derivation, symbol: int | None = None) -> SententialForm:
        """The word that a complete derivation leads to.

        Raises:
            GrammarError: it takes a step that is not legal, or stops early; the message names the step.
        """
        try:
            word, rest = self.leftmost.follow(self.start(symbol), derivation)
        except KeyError as error:
            raise GrammarError(f"step {error.args[0] + 1} of the derivation is not legal", "derive it again") from None
        if rest.symbols:
            raise GrammarError(f"the derivation stops at {self.text(rest)!r}", "add the missing steps")
        return SententialForm(word)

    def enumerate(self, symbol: int | None = None, most: int = 1_000_000) -> Iterator[tuple[Derivation, Word]]:
        """Derivations with their words, depth-first; an ambiguous word comes more than once."""
        return self.leftmost.words(self.start(symbol), most)

    def extended(self, block: int, words: Iterable[Derivation]) -> BoundGrammar:
        """The grammar with extra productions: from a block to sub-trees already derived from it."""
        extra = []
        for number, derivation in enumerate(words, len(self.productions)):
            rhs = self.derive(derivation, block).symbols
            steps = [self.productions[step] for step in derivation]
            use, clash = self._used_by(steps)
            base = self.base_derivation(derivation)
            extra.append(Production(number, block, rhs, self._levels(rhs), 1.0, None, use, clash, base))
        own = tuple(production.use for production in extra)
        costs = evolve(self.costs, use=self.costs.use + own)
        return evolve(self, productions=self.productions + tuple(extra), costs=costs)

    def base_derivation(self, derivation: Derivation) -> Derivation:
        """The derivation with every extra production replaced by the steps it stands for."""
        if not self._has_extra:
            return derivation
        return tuple(step for number in derivation for step in (self.productions[number].base or (number,)))

    @cached_property
    def _has_extra(self) -> bool:
        return any(production.base for production in self.productions)

    def _used_by(self, steps: list[Production]) -> tuple[tuple[int, ...], tuple[int, ...]]:
        use = [0] * len(self.costs.constraints)
        clash: list[int] = []
        for step in steps:
            for at, constraint in enumerate(self.costs.constraints):
                if constraint.kind != "unique":
                    use[at] += step.use[at]
                    continue
                if use[at] & step.use[at] or at in step.clash:
                    clash.append(at)
                use[at] |= step.use[at]
        return tuple(use), tuple(dict.fromkeys(clash))

    def _levels(self, word: Word) -> tuple[int, ...]:
        opening, closing = self.brackets
        found, level = [], 0
        for symbol in word:
            level -= symbol == closing
            found.append(level)
            level += symbol == opening
        return tuple(found)


def _node(sign: str, children: tuple[Node, ...]) -> Node:
    if sign == "?":
        return Fallback(children)
    if sign == "→":
        return Sequence(children)
    return Not(children[0]) if sign == "!" else Parallel(children, int(sign[1:]))
