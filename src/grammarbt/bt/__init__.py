"""Behavior trees: the model, the one-line notation, what a tick means, and what is true of a tree."""

from grammarbt.bt.canonical import all_pure, behave_alike, canonical_key, none_pure
from grammarbt.bt.check import DeadLeaf, dead_leaves
from grammarbt.bt.compare import Answer, Difference, difference
from grammarbt.bt.generate import compile_source, generate_source
from grammarbt.bt.linked import Answers, Ticker, ticker
from grammarbt.bt.model import (
    MAX_DEPTH,
    Action,
    Arguments,
    BehaviorTree,
    Condition,
    Fallback,
    Leaf,
    Node,
    Not,
    Parallel,
    Sequence,
    children,
    depth,
    leaves,
    numbered,
    rebuild,
    walk,
    with_children,
    without,
)
from grammarbt.bt.notation import format_leaf, format_tree, parse
from grammarbt.bt.policy import Entry, FlatTree, Policy, compile_policy, flatten, tick
from grammarbt.bt.status import Status
from grammarbt.bt.trace import node_statuses

__all__ = [
    "MAX_DEPTH",
    "Action",
    "Answer",
    "Answers",
    "Arguments",
    "BehaviorTree",
    "Condition",
    "DeadLeaf",
    "Difference",
    "Entry",
    "Fallback",
    "FlatTree",
    "Leaf",
    "Node",
    "Not",
    "Parallel",
    "Policy",
    "Sequence",
    "Status",
    "Ticker",
    "all_pure",
    "behave_alike",
    "canonical_key",
    "children",
    "compile_policy",
    "compile_source",
    "dead_leaves",
    "depth",
    "difference",
    "flatten",
    "format_leaf",
    "format_tree",
    "generate_source",
    "leaves",
    "node_statuses",
    "none_pure",
    "numbered",
    "parse",
    "rebuild",
    "tick",
    "ticker",
    "walk",
    "with_children",
    "without",
]
