"""Bind and check a large grammar: `python benchmarks/grammar_scale.py [GROUPS]`.

`scheide.grammar` over groups of five actions and five conditions; 100 groups have 1,000 leaves.
"""

from __future__ import annotations

import sys
from time import process_time

import numpy as np

from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import bind, load_grammar, shipped_grammars
from grammarbt.grammar.check import check


def main(groups: int = 100) -> None:
    """Print the seconds that each step takes, by the process's own clock."""
    vocabulary = Vocabulary(tuple(map(_group, range(groups))))
    begin = process_time()
    grammar = load_grammar(shipped_grammars()["scheide"])
    read = process_time()
    bound = bind(grammar, vocabulary)
    written = process_time()
    report = check(grammar, vocabulary)
    checked = process_time()
    bound.sample(np.random.default_rng(0))
    sampled = process_time()
    print(f"{groups} groups, {len(vocabulary.leaves):,} leaves, {len(bound.productions):,} productions")
    print(f"read {read - begin:.2f} s, bind {written - read:.2f} s, check {checked - written:.2f} s")
    print(f"first sample {sampled - checked:.2f} s; {report.summary}"[:200])


def _group(number: int) -> Group:
    actions = tuple(ActionType(f"action {number}.{at}") for at in range(5))
    return Group(f"g{number}", actions, tuple(ConditionType(f"condition {number}.{at}") for at in range(5)))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
