"""Behavior trees: the model, the one-line notation, and what a tick means."""

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
    rebuild,
    walk,
)
from grammarbt.bt.notation import format_leaf, format_tree, parse
from grammarbt.bt.policy import Entry, FlatTree, Policy, compile_policy, flatten, tick
from grammarbt.bt.status import Status

__all__ = [
    "MAX_DEPTH",
    "Action",
    "Arguments",
    "BehaviorTree",
    "Condition",
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
    "children",
    "compile_policy",
    "depth",
    "flatten",
    "format_leaf",
    "format_tree",
    "leaves",
    "parse",
    "rebuild",
    "tick",
    "walk",
]
