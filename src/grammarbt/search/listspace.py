"""The space of lists: a control node at the root, and under it one sub-tree of a block after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from grammarbt.bt import BehaviorTree
from grammarbt.search.bandits import Bandit
from grammarbt.search.base import SearchContext
from grammarbt.search.behaviours import behaviour_of
from grammarbt.search.blocks import BlockDag, Stream
from grammarbt.search.listmoves import ListNeighbours, ListParts
from grammarbt.search.race import Runner
from grammarbt.search.rootlist import ListedTree, RootList
from grammarbt.search.trim import trimmed


def block_dags(context: SearchContext, most: int) -> dict[int, BlockDag]:
    """The DAG of each block that has words; blocks of more than `most` words are sampled."""
    behaviour = behaviour_of(context)
    dags = [BlockDag(context.grammar, block, behaviour, most) for block in context.grammar.blocks]
    return {dag.block: dag for dag in dags if dag.words}


class ListSpace:
    """Lists of sub-trees.

    Args:
        lists: puts sub-trees together.
        streams: draw the sub-trees of each block.
        bandit: chooses what to change; None chooses by weight.
        most: words of a block among which a start tree's sub-trees are looked for.
        trim: whether sub-trees that were never ticked are dropped, and others added only where ticks arrive.
    """

    def __init__(
        self,
        lists: RootList,
        streams: Mapping[int, Stream],
        bandit: Bandit | None = None,
        *,
        most: int,
        trim: bool = True,
    ) -> None:
        self.parts = ListParts(lists, streams, bandit, trim)
        self.most = most

    @property
    def nodes(self) -> int:
        """Nodes of the block DAGs."""
        return sum(len(stream.dag.nodes) for stream in self.parts.streams.values())

    def sample(self, rng: np.random.Generator) -> ListedTree:
        """A random list."""
        return self.parts.lists.sample(rng)

    def recognised(self, tree: BehaviorTree) -> ListedTree | None:
        """The list that is this tree."""
        return self.parts.lists.recognise(tree, self.most)

    def trimmed(self, root: Runner) -> Runner:
        """The root without sub-trees that were never ticked."""
        return trimmed(root, self.parts.lists) if self.parts.trim else root

    def around(self, root: ListedTree, rng: np.random.Generator) -> ListNeighbours:
        """Lists one step away."""
        return ListNeighbours(root.pieces, self.parts, rng)

    def remember(self, elites: Sequence[ListedTree]) -> None:
        """Draw their sub-trees more often."""
        self.parts.known.clear()
        for piece in dict.fromkeys(piece for elite in elites for piece in elite.pieces):
            self.parts.known.setdefault(piece.block, []).append(piece)
