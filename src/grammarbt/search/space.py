"""What a climbing search moves in: trees that can be changed step by step, and the neighbours of one of them."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Protocol

import numpy as np
from attrs import define, field, frozen

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import parse_tree
from grammarbt.search.bandits import Arm
from grammarbt.search.edits import Edits
from grammarbt.search.race import Runner
from grammarbt.search.rootlist import ListedTree
from grammarbt.search.site import Site

DRAWS = 200


@frozen(eq=False)
class Neighbour:
    """A tree one step from the root.

    Attributes:
        key: tells it apart from others.
        listed: the tree.
        credited: what its advantage is credited to, by the rule that drew it.
    """

    key: Hashable
    listed: ListedTree
    credited: tuple[Arm, ...] = ()


@define(eq=False)
class Memory:
    """What a root knows of its neighbours.

    Attributes:
        closed: not to be drawn again.
        waiting: lost once, and get one more chance.
    """

    closed: set[Hashable] = field(factory=set)
    waiting: dict[Hashable, Runner] = field(factory=dict)


class Around(Protocol):
    """The neighbours of a root."""

    memory: Memory

    def draw(self) -> Neighbour | None:
        """A tree that is not closed; None if none was found."""
        ...

    def look(self, root: Runner) -> None:
        """Take in what the root's ticks say by now."""
        ...

    def credit(self, neighbour: Neighbour, advantage: float) -> None:
        """Learn how much a neighbour gained over the root, from -1 to 1."""
        ...


class Space(Protocol):
    """Trees that can be changed step by step."""

    @property
    def nodes(self) -> int:
        """Partial trees met so far."""
        ...

    def sample(self, rng: np.random.Generator) -> ListedTree:
        """A random tree."""
        ...

    def recognised(self, tree: BehaviorTree) -> ListedTree | None:
        """The tree, if the space has it."""
        ...

    def trimmed(self, root: Runner) -> Runner:
        """The root without what was never ticked; the root itself if there is nothing to drop."""
        ...

    def around(self, root: ListedTree, rng: np.random.Generator) -> Around:
        """The neighbours of a tree."""
        ...

    def remember(self, elites: Sequence[ListedTree]) -> None:
        """Take note of the best roots so far."""
        ...


class EditSpace:
    """All derivations of a grammar.

    Args:
        edits: changes them.
    """

    def __init__(self, edits: Edits) -> None:
        self.edits = edits
        self.elites: list[Site] = []

    @property
    def nodes(self) -> int:
        """None are kept."""
        return 0

    def sample(self, rng: np.random.Generator) -> ListedTree:
        """A random tree, short ones first."""
        return self._listed(self.edits.sample(rng))

    def recognised(self, tree: BehaviorTree) -> ListedTree:
        """The tree with its derivation; an error says where it leaves the language."""
        return ListedTree((), tree, parse_tree(self.edits.grammar, tree))

    def trimmed(self, root: Runner) -> Runner:
        """The root as it is; edits delete what is useless."""
        return root

    def around(self, root: ListedTree, rng: np.random.Generator) -> EditedTrees:
        """Derivations some edits away."""
        return EditedTrees(root, self.edits, self.elites, rng)

    def remember(self, elites: Sequence[ListedTree]) -> None:
        """Edits may borrow from them."""
        self.elites = [self.edits.site(elite.derivation) for elite in elites]

    def _listed(self, derivation: tuple[int, ...]) -> ListedTree:
        return ListedTree((), self.edits.states.tree(derivation), derivation)


class EditedTrees:
    """The derivations a few edits from a root.

    Args:
        root: where edits begin.
        edits: random changes.
        elites: what edits may borrow from.
        rng: randomness.
    """

    def __init__(self, root: ListedTree, edits: Edits, elites: Sequence[Site], rng: np.random.Generator) -> None:
        self.site = edits.site(root.derivation)
        self.edits = edits
        self.elites = elites
        self.rng = rng
        self.memory = Memory({root.derivation})

    def draw(self) -> Neighbour | None:
        """A derivation that is not closed."""
        for _ in range(DRAWS):
            found = self.edits.neighbour(self.site, self.elites, self.rng)
            if found is not None and found not in self.memory.closed:
                return Neighbour(found, ListedTree((), self.edits.states.tree(found), found))
        return None

    def look(self, root: Runner) -> None:
        """Edits go anywhere."""

    def credit(self, neighbour: Neighbour, advantage: float) -> None:
        """Edits are drawn by fixed weights."""
