"""Languages small enough to reason about, whose trees are scored by a formula: a search on one takes moments."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Literal

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree, children, leaves, parse
from grammarbt.bt.canonical import canonical_key
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import BoundGrammar, Source, bind, load_grammar
from grammarbt.search import Evaluation, Proposal, SearchContext, Searcher

_LETTERS = """
%declare ACTION CONDITION
%limit nodes 7
start: "?" "(" part+ ")"
part: ACTION | "→" "(" CONDITION ACTION ")"
"""
_ERRANDS = """
%declare ACTION CONDITION
%forall g in GROUP
%unique ACTION CONDITION in subtree
%unique g in start
start: "?" "(" each each+ ")"
each: subtree{g}
subtree{g}: "→" "(" ACTION{g} ")" | "→" "(" left{g} ACTION{g} ")" | "→" "(" ACTION{g} right{g} ")"
left{g}: left{g} check{g} | check{g}
right{g}: ACTION{g} right{g} | ACTION{g}
check{g}: CONDITION{g} | "!" "(" CONDITION{g} ")"
"""
_FOUND, _IN_PLACE, _EXTRA = 10.0, 2.0, 0.1


@frozen
class Puzzle:
    """A language, what each of its trees is worth, and a tree that is worth most.

    Attributes:
        grammar: the language.
        vocabulary: its leaves.
        value: what a tree is worth; the return of an episode is this plus noise.
        solution: no tree is worth more.
        noise: standard deviation of the noise, which the scenario fixes for all trees alike.
    """

    grammar: BoundGrammar
    vocabulary: Vocabulary
    value: Callable[[BehaviorTree], float]
    solution: BehaviorTree
    noise: float

    def context(
        self,
        seed: int = 0,
        budget: int = 1_000,
        depends_on: Literal["behaviour", "tree"] = "behaviour",
        start: BehaviorTree | None = None,
    ) -> SearchContext:
        """What a searcher is made from."""
        return SearchContext(self.grammar, self.vocabulary, np.random.default_rng(seed), budget, depends_on, start)

    def score(self, tree: BehaviorTree, scenario: int) -> float:
        """The return of an episode."""
        return self.value(tree) + self.noise * float(np.random.default_rng(scenario).normal())

    def evaluate(self, proposal: Proposal) -> Evaluation:
        """The returns of a proposal, as if each leaf were ticked once per episode."""
        returns = tuple(self.score(proposal.tree, scenario) for scenario in range(proposal.start, proposal.stop))
        return Evaluation(proposal, returns, (len(returns),) * len(leaves(proposal.tree)))

    def drive(
        self,
        searcher: Searcher,
        episodes: int,
        width: int = 1,
        evaluate: Callable[[Proposal], Evaluation] | None = None,
    ) -> list[Proposal]:
        """Ask and tell until so many episodes are spent, or nothing is proposed; gives what was proposed.

        Args:
            searcher: made from a context of this puzzle.
            episodes: to spend at least; a known return costs as much as a new one.
            width: proposals to ask for at a time.
            evaluate: answers in place of the puzzle, such as with failures.
        """
        proposals, spent = list[Proposal](), 0
        while spent < episodes and (asked := searcher.ask(width)):
            proposals += asked
            spent += sum(proposal.stop - proposal.start for proposal in asked)
            searcher.tell([(evaluate or self.evaluate)(proposal) for proposal in asked])
        return proposals


def letters() -> Puzzle:
    """Lists of the letters a, b and c; a tree is worth the more the more a it holds, and the less the longer it is."""

    def value(tree: BehaviorTree) -> float:
        names = [leaf.name for leaf in leaves(tree)]
        return names.count("a") - _EXTRA * len(names)

    vocabulary = Vocabulary((Group("letters", tuple(map(ActionType, "abc")), (ConditionType("x"),)),))
    return Puzzle(_bound(_LETTERS, vocabulary), vocabulary, value, parse("?( [a] [a] [a] [a] [a] [a] )"), noise=0.1)


def errands(
    grammar: str = _ERRANDS,
    solution: str = "?( →( (hungry) !(full) [eat] ) →( (tired) [sleep] ) →( [walk] ) )",
    noise: float = 1.0,
) -> Puzzle:
    """Lists of sub-trees; one that behaves like a sub-tree of the solution is worth 10, and 2 more in the same place.

    Args:
        grammar: another language over the same leaves, in the grammar language.
        solution: a tree of it, in the one-line notation.
        noise: standard deviation.
    """
    key = cache(canonical_key)
    goal = parse(solution)
    wanted = [key(part) for part in children(goal)]

    def value(tree: BehaviorTree) -> float:
        found = [key(part) for part in children(tree)]
        in_place = sum(one == other for one, other in zip(wanted, found, strict=False))
        return _FOUND * sum(part in found for part in wanted) + _IN_PLACE * in_place - _EXTRA * len(found)

    groups = (
        Group("food", (ActionType("eat"), ActionType("cook")), (ConditionType("hungry"), ConditionType("full"))),
        Group("rest", (ActionType("sleep"),), (ConditionType("tired"),)),
        Group("move", (ActionType("walk"),)),
    )
    vocabulary = Vocabulary(groups)
    return Puzzle(_bound(grammar, vocabulary), vocabulary, value, goal, noise)


def _bound(text: str, vocabulary: Vocabulary) -> BoundGrammar:
    return bind(load_grammar(Source("puzzle.grammar", text)), vocabulary)
