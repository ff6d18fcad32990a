"""When two trees are one too many."""

from __future__ import annotations

from grammarbt.bt import BehaviorTree
from grammarbt.bt.fingerprint import Fingerprints
from grammarbt.search.base import SearchContext
from grammarbt.search.blocks import Behaviour


def behaviour_of(context: SearchContext) -> Behaviour:
    """Equal for trees with equal returns: by behaviour, or the tree itself where the domain's return depends on it."""
    if context.depends_on == "tree":
        return _itself
    return Fingerprints(context.vocabulary.pure.__contains__)


def _itself(tree: BehaviorTree) -> object:
    return tree
