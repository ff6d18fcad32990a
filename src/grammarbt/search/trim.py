"""What a root's ticks say: which sub-trees never ran, and how far along the list ticks arrive."""

from __future__ import annotations

from attrs import evolve

from grammarbt.search.race import Runner
from grammarbt.search.rootlist import RootList

EPISODES = 4
"""Episodes after which a sub-tree that was never ticked is dropped."""
FEWEST_PIECES = 2


def trimmed(root: Runner, lists: RootList) -> Runner:
    """The root without sub-trees that were never ticked; the root itself if there are none, or too little is known.

    Its returns stay, since what is never ticked changes nothing.
    """
    if root.watched < EPISODES:
        return root
    counts = _ticks_by_piece(root)
    alive = [at for at, ticks in enumerate(counts) if ticks]
    spare = [at for at, ticks in enumerate(counts) if not ticks][: max(0, FEWEST_PIECES - len(alive))]
    kept = sorted([*alive, *spare])
    if len(kept) == len(counts):
        return root
    listed = lists.assemble([root.listed.pieces[at] for at in kept])
    if listed is None:
        return root
    ends = _ends(root)
    ticks = [count for at in kept for count in root.ticks[ends[at] - root.listed.pieces[at].size : ends[at]]]
    return evolve(root, listed=listed, ticks=ticks)


def reached_positions(root: Runner) -> int:
    """Places, from the left, where another sub-tree would be ticked, as far as is known."""
    pieces = len(root.listed.pieces)
    if root.watched < EPISODES:
        return pieces + 1
    last = max((at for at, ticks in enumerate(_ticks_by_piece(root)) if ticks), default=-1)
    return pieces + 1 if last == pieces - 1 else last + 1


def _ticks_by_piece(root: Runner) -> list[int]:
    ends = _ends(root)
    return [sum(root.ticks[end - piece.size : end]) for end, piece in zip(ends, root.listed.pieces, strict=True)]


def _ends(root: Runner) -> list[int]:
    """Where each piece's leaves end among the tree's."""
    ends, at = [], 0
    for piece in root.listed.pieces:
        at += piece.size
        ends.append(at)
    return ends
