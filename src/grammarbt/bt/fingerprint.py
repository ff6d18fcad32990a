"""A tree's fingerprint: a number that trees share when they behave alike, found in one pass over the leaves.

Between two calls the world stands still, and a test of c is the polynomial `c·true + (1 - c)·false`. Where no condition is
asked twice, trees behave alike exactly when their polynomials are equal, and others hardly ever agree at a random point
(Blum, Chandra & Wegman, *Equivalence of Free Boolean Graphs Can Be Decided Probabilistically in Polynomial Time*, 1980).
So conditions need not be brought into order. A tree that asks one twice is reduced to its decision graph first.
"""

from __future__ import annotations

from hashlib import blake2b
from typing import TYPE_CHECKING

from grammarbt.bt.canonical import reduced_graph
from grammarbt.bt.compiler import RUNNING, Steps, compile_steps
from grammarbt.bt.model import Action, Condition

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.bt.model import BehaviorTree, Leaf

_PRIME = 2**127 - 1
_BYTES = 16
_CALL_BYTES = 15
"""Numbers of calls stay below the prime."""


class Fingerprints:
    """Takes fingerprints, which are the same in every process.

    Trees that behave alike share one. Two others, of n leaves each, do with a probability of about n/2^120. What is too
    large for `canonical_key` to reduce, and asks a condition twice, is told apart no better than there.

    Args:
        is_pure: whether a condition draws no randomness and changes only when an action runs.
    """

    def __init__(self, is_pure: Callable[[Condition], bool]) -> None:
        self._is_pure = is_pure
        self._signs: dict[str, int | bytes] = {}
        self._ends = [_call(end, 0, 0, 0) for end in (b"running", b"failure", b"success")]

    def __call__(self, tree: BehaviorTree) -> bytes:
        """A tree's fingerprint, of 16 bytes.

        Raises:
            DomainError: nested parallel nodes need more than `MAX_STEPS` steps.
        """
        number = self._of_steps(compile_steps(tree))
        return (self._of_graph(tree) if number is None else number).to_bytes(_BYTES, "big")

    def _of_steps(self, steps: Steps) -> int | None:
        """The number of the first step; None where a pure condition stands in two of them."""
        values = [0] * len(steps.steps) + self._ends  # at -3, -2 and -1, as steps name the ends
        signs, asked = self._signs, set()
        for at, (leaf, _, success, failure, running) in enumerate(steps.steps):
            text = leaf.text
            sign = signs[text] if text in signs else self._meet(leaf)
            if isinstance(sign, int):
                if sign in asked:
                    return None
                asked.add(sign)
                values[at] = _test(sign, values[success], values[failure])
            else:
                after = running if isinstance(leaf, Action) else RUNNING
                values[at] = _call(sign, values[success], values[failure], values[after])
        return values[steps.first]

    def _of_graph(self, tree: BehaviorTree) -> int:
        """The same from the reduced graph, in which no condition is asked twice."""
        graph, start = reduced_graph(tree, self._is_pure)
        values = [0] * len(graph.nodes) + self._ends
        for at, (text, *following) in enumerate(graph.nodes):
            won, lost, running = (values[node] for node in following)
            pure = at in graph.tests
            values[at] = _test(_point(text), won, lost) if pure else _call(text.encode(), won, lost, running)
        return values[start]

    def _meet(self, leaf: Leaf) -> int | bytes:
        """A number for a pure condition, bytes for what is called."""
        text = leaf.text
        pure = isinstance(leaf, Condition) and self._is_pure(leaf)
        sign = self._signs[text] = _point(text) if pure else text.encode()
        return sign


def text_fingerprint(text: str) -> bytes:
    """Of a tree in the one-line notation, for who cares about more than behaviour."""
    return blake2b(text.encode(), digest_size=_BYTES).digest()


def _point(condition: str) -> int:
    """Where the polynomials are evaluated."""
    return _call(condition.encode(), 0, 0, 0)


def _test(point: int, true: int, false: int) -> int:
    return (false + point * (true - false)) % _PRIME


def _call(leaf: bytes, success: int, failure: int, running: int) -> int:
    """A number that looks random and depends on the arguments alone."""
    data = b"%b\n%x\n%x\n%x" % (leaf, success, failure, running)
    return int.from_bytes(blake2b(data, digest_size=_CALL_BYTES).digest(), "big")
