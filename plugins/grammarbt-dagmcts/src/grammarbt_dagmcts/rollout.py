"""Roll-outs: random words below the nodes of a DAG."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from attrs import frozen

from grammarbt.grammar import BoundGrammar, SententialForm
from grammarbt.search import Proposal, Step, leftmost, pick, position_of
from grammarbt_dagmcts.dag import Node


@frozen(eq=False)
class RollOut:
    """A selected path, from the root to a node, and a random word below that node."""

    path: tuple[Node, ...]
    proposal: Proposal


class RollOuts:
    """Finishes trees by random productions, and the shortest way when they take too many.

    Args:
        grammar: of the nodes.
        rng: randomness.
        longest: random productions of a roll-out.
    """

    def __init__(self, grammar: BoundGrammar, rng: np.random.Generator, longest: int) -> None:
        self.grammar = grammar
        self.rng = rng
        self.longest = longest
        self._least = least_steps(grammar)

    def below(self, path: tuple[Node, ...], scenario: int) -> RollOut:
        """A roll-out from the path's last node, to be simulated on one scenario."""
        steps = self._steps(path)
        form = path[-1].form
        last = len(steps) + self.longest
        while not self.grammar.is_word(form):
            production = self._random(form) if len(steps) < last else self._shortest(form)
            steps.append((form, self.grammar.positions(form)[0], production))
            form = self.grammar.apply(form, production)
        derivation = tuple(production for production in leftmost(self.grammar, steps) if production is not None)
        base = self.grammar.base_derivation(derivation)
        return RollOut(path, Proposal(self.grammar.tree(form), base, scenario, scenario + 1))

    def _steps(self, path: tuple[Node, ...]) -> list[Step]:
        steps: list[Step] = []
        for parent, child in pairwise(path):
            production = parent.children[child.number][1]
            steps.append((parent.form, position_of(self.grammar, parent.form, production, child.form), production))
        return steps

    def _random(self, form: SententialForm) -> int:
        legal = self.grammar.legal(form)
        weights = [self.grammar.productions[production].weight for production in legal]
        drawn = float(self.rng.random()) * sum(weights)
        for production, weight in zip(legal, weights, strict=True):
            drawn -= weight
            if drawn < 0.0:
                return production
        return legal[-1]

    def _shortest(self, form: SententialForm) -> int:
        """One of the productions after which the fewest are left to do."""
        legal = self.grammar.legal(form)
        least = min(self._least[production] for production in legal)
        return pick([production for production in legal if self._least[production] == least], self.rng)


def least_steps(grammar: BoundGrammar) -> list[float]:
    """Per production, the productions of the shortest derivation that begins with it, constraints aside."""
    least: dict[int, float] = {}
    while True:
        steps = [
            1.0 + sum(least.get(symbol, float("inf")) for symbol in production.rhs if grammar.is_nonterminal(symbol))
            for production in grammar.productions
        ]
        shorter = {lhs: min(steps[production.number] for production in own) for lhs, own in grammar.by_lhs.items()}
        if shorter == least:
            return steps
        least = shorter
