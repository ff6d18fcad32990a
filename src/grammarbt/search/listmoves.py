"""The edges out of a list: add or change a sub-tree of some block, move one, delete one."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from itertools import accumulate
from typing import Literal

import numpy as np
from attrs import define, field, frozen

from grammarbt.grammar import Derivation
from grammarbt.search.bandits import Arm, Bandit
from grammarbt.search.blocks import BlockNode, Piece, Stream
from grammarbt.search.race import Runner
from grammarbt.search.rootlist import RootList
from grammarbt.search.space import Memory, Neighbour
from grammarbt.search.trim import reached_positions

INSERT = 0.85
"""Chance that adding inserts; else it replaces what stands there."""
UNDO = 0.25
"""Chance that changing undoes the last productions of the sub-tree and derives it again; else it draws a new one."""
MOST_UNDONE = 6
MOVE_CHANGED = 0.7
"""Chance that a changed sub-tree also moves."""
BLIND_EDGE = 0.5
"""Chance that an edge is drawn by weight, though the bandit has its turn."""
BORROWED = 0.25
"""Chance that a sub-tree is one of an elite's, once there are elites."""
FURTHER_EDGE = 0.15
MOST_EDGES = 3
ABSENT = 6.0
"""How much more a block weighs that the root lacks, in blind draws."""
MOVE_WEIGHT = 3.0
DELETE_WEIGHT = 0.7
INFORMED_DRAWS = 4
BLIND_DRAWS = 200

Key = tuple[tuple[int, ...], ...]


@frozen
class Edge:
    """A kind of edge; `block` is the nonterminal that is added or changed."""

    kind: Literal["add", "change", "move", "delete"]
    block: int = -1


@define(eq=False)
class Draft:
    """A tree under construction: its pieces, the way through the block DAGs, and how many root positions are reached."""

    pieces: list[Piece]
    reached: int
    path: list[BlockNode] = field(factory=list)


def key_of(pieces: Sequence[Piece]) -> Key:
    """Tells lists of pieces apart."""
    return tuple(piece.word for piece in pieces)


@frozen(eq=False)
class ListParts:
    """What neighbours of lists are made of.

    Attributes:
        lists: puts sub-trees together.
        streams: draw the sub-trees of each block.
        bandit: chooses edges; None chooses by weight.
        trim: whether sub-trees are added only where ticks arrive.
        known: per block, the sub-trees of the best lists so far.
    """

    lists: RootList
    streams: Mapping[int, Stream]
    bandit: Bandit | None
    trim: bool
    known: dict[int, list[Piece]] = field(factory=dict)


class ListNeighbours:
    """Everything one step from a root.

    Args:
        root: its pieces.
        parts: what neighbours are made of.
        rng: randomness.
    """

    def __init__(self, root: Sequence[Piece], parts: ListParts, rng: np.random.Generator) -> None:
        self.root = tuple(root)
        self.parts = parts
        self.rng = rng
        self.reached = len(self.root) + 1
        self.arms = {edge: Arm() for edge in self._edges()}
        self._order = list(self.arms)
        self._shares = list(accumulate(self._weight(edge) for edge in self._order))
        self.memory = Memory({key_of(self.root)})

    def look(self, root: Runner) -> None:
        """See how far along the list the root's ticks arrive."""
        if self.parts.trim:
            self.reached = reached_positions(root)

    def credit(self, neighbour: Neighbour, advantage: float) -> None:
        """Credit the edge and the way down."""
        if self.parts.bandit is not None:
            self.parts.bandit.observe(advantage)
            for arm in neighbour.credited:
                self.parts.bandit.credit(arm, advantage)

    def _edges(self) -> list[Edge]:
        present = [piece.block for piece in self.root]
        adds = [Edge("add", block) for block in self.parts.streams if self._can_add(block)]
        changes = [Edge("change", block) for block in self.parts.streams if block in present]
        return [*adds, *changes, Edge("move"), Edge("delete")]

    def _can_add(self, block: int) -> bool:
        own = tuple(piece.block for piece in self.root)
        return any(self.parts.lists.allows((*own[:at], block, *own[at:])) for at in range(len(own) + 1))

    def draw(self) -> Neighbour | None:
        """A tree that is not closed; None if none was found. The bandit goes first, then everything by weight."""
        for attempt in range(INFORMED_DRAWS + BLIND_DRAWS):
            bandit = self.parts.bandit if attempt < INFORMED_DRAWS else None
            by_weight = bandit is None or self.rng.random() < BLIND_EDGE
            edge = self._edge_by_weight() if by_weight or bandit is None else self._urgent_edge(bandit)
            neighbour = self._step(edge)
            if neighbour is not None:
                return neighbour
        return None

    def _step(self, edge: Edge) -> Neighbour | None:
        draft = Draft(list(self.root), self.reached)
        self._take(edge, draft)
        edges = 1
        while edges < MOST_EDGES and self.rng.random() < FURTHER_EDGE:
            self._take(self._edge_by_weight(), draft)
            edges += 1
        key = key_of(draft.pieces)
        listed = None if key in self.memory.closed else self.parts.lists.assemble(draft.pieces)
        if listed is None:
            return None
        return Neighbour(key, listed, (self.arms[edge], *draft.path) if edges == 1 else ())

    def _take(self, edge: Edge, draft: Draft) -> None:
        if edge.kind == "add":
            self._add(edge.block, draft)
        elif edge.kind == "change":
            self._change(edge.block, draft)
        elif edge.kind == "move":
            self._move(self._below(len(draft.pieces)), draft)
        elif len(draft.pieces) > 1:
            del draft.pieces[self._below(len(draft.pieces))]

    def _add(self, block: int, draft: Draft) -> None:
        piece = self._draw_piece(block, (), draft)
        at = self._position(draft)
        end = at if self.rng.random() < INSERT else at + 1
        draft.pieces[at:end] = [piece]

    def _change(self, block: int, draft: Draft) -> None:
        places = [at for at, piece in enumerate(draft.pieces) if piece.block == block]
        if not places:
            return
        at = places[self._below(len(places))]
        prefix: Derivation = ()
        if self.rng.random() < UNDO:
            old = draft.pieces[at].derivation
            prefix = old[: max(0, len(old) - 1 - self._below(MOST_UNDONE))]
        draft.pieces[at] = self._draw_piece(block, prefix, draft)
        if self.rng.random() < MOVE_CHANGED:
            self._move(at, draft)

    def _move(self, at: int, draft: Draft) -> None:
        piece = draft.pieces.pop(at)
        draft.pieces.insert(self._position(draft), piece)

    def _draw_piece(self, block: int, prefix: Derivation, draft: Draft) -> Piece:
        known = () if prefix else self.parts.known.get(block, [])
        if known and self.rng.random() < BORROWED:
            return known[self._below(len(known))]
        path, piece = self.parts.streams[block].draw(self.rng, prefix)
        draft.path.extend(path)
        return piece

    def _position(self, draft: Draft) -> int:
        return self._below(min(draft.reached, len(draft.pieces) + 1))

    def _below(self, n: int) -> int:
        return int(self.rng.random() * n)

    def _urgent_edge(self, bandit: Bandit) -> Edge:
        """The edge with the highest index; untried ones first, at random."""
        untried = [edge for edge, arm in self.arms.items() if not arm.visits]
        if untried:
            return untried[self._below(len(untried))]
        trials = sum(arm.visits for arm in self.arms.values())
        return max(self.arms, key=lambda edge: bandit.index(self.arms[edge], self.arms[edge].visits, trials))

    def _edge_by_weight(self) -> Edge:
        drawn = float(self.rng.random()) * self._shares[-1]
        return self._order[bisect_right(self._shares, drawn)]

    def _weight(self, edge: Edge) -> float:
        if edge.kind == "move":
            return MOVE_WEIGHT
        if edge.kind == "delete":
            return DELETE_WEIGHT
        return self.parts.streams[edge.block].dag.weight * (ABSENT if edge.kind == "add" else 1.0)
