"""Derivations in any order, and the sub-trees that searchers treat as units."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from grammarbt.errors import GrammarError
from grammarbt.grammar import BoundGrammar, Derivation, SententialForm

Step = tuple[SententialForm, int, int]
"""A form, the position that was rewritten, and the production."""

Template = tuple[int | None, ...]
"""A leftmost derivation in which None stands for a nonterminal that was left alone."""


def leftmost(grammar: BoundGrammar, steps: Iterable[Step]) -> Template:
    """The leftmost order of a derivation from one nonterminal, whose steps may come in any order."""
    turns = ((grammar.positions(form).index(position), production) for form, position, production in steps)
    return rearranged(grammar, turns)


def rearranged(grammar: BoundGrammar, turns: Iterable[tuple[int, int]]) -> Template:
    """The same of steps that say which of the nonterminals is rewritten, from the left, and by what production."""
    parts = grammar.parts
    template: list[int | None] = [None]
    for at, production in turns:
        place = template.index(None)
        for _ in range(at):
            place = template.index(None, place + 1)
        template[place] = production
        template[place + 1 : place + 1] = [None] * len(parts[production])
    return tuple(template)


def complete(template: Template, parts: Sequence[Derivation]) -> Derivation:
    """The template with a derivation in the place of each nonterminal that was left alone."""
    found: list[int] = []
    remaining = iter(parts)
    for production in template:
        if production is None:
            found.extend(next(remaining))
        else:
            found.append(production)
    return tuple(found)


def block_derivations(grammar: BoundGrammar, derivation: Derivation) -> list[tuple[int, Derivation]]:
    """The outermost blocks of a derivation, left to right, each with its own part of the derivation."""
    found: list[tuple[int, Derivation]] = []
    at = 0
    while at < len(derivation):
        symbol = grammar.productions[derivation[at]].lhs
        if symbol in grammar.blocks:
            end = end_of(grammar.growth, derivation, at)
            found.append((symbol, derivation[at:end]))
            at = end
        else:
            at += 1
    return found


def position_of(grammar: BoundGrammar, parent: SententialForm, production: int, child: SententialForm) -> int:
    """Where a production must be applied to the parent to get the child."""
    lhs = grammar.productions[production].lhs
    candidates = [at for at in grammar.positions(parent) if parent.symbols[at] == lhs]
    return next(at for at in candidates if _leads_to(grammar, parent, production, at, child))


def _leads_to(
    grammar: BoundGrammar, parent: SententialForm, production: int, position: int, child: SententialForm
) -> bool:
    try:
        return grammar.apply(parent, production, position) == child
    except GrammarError:  # it breaks a constraint there
        return False


def end_of(growth: Sequence[int], derivation: Derivation, at: int) -> int:
    """Where the part of a derivation ends that begins at a step; `growth` is the grammar's."""
    pending = 1
    while pending:
        pending += growth[derivation[at]]
        at += 1
    return at
