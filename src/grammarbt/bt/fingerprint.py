"""A tree's fingerprint: a number that trees share when they behave alike, found in one pass over the leaves.

Between two calls the world stands still, and a test of c is the polynomial `c·true + (1 - c)·false`. Where no condition is
asked twice on the way, trees behave alike exactly when their polynomials are equal, and others hardly ever agree at a random
point (Blum, Chandra & Wegman, *Equivalence of Free Boolean Graphs Can Be Decided Probabilistically in Polynomial Time*,
1980). So conditions need not be brought into order, as in `canonical`; it is enough that none is asked twice.
"""

from __future__ import annotations

from hashlib import blake2b
from typing import TYPE_CHECKING, TypeAlias

from grammarbt.bt.bdd import TooLargeError
from grammarbt.bt.canonical import MAX_CONDITIONS, MAX_NODES, none_pure
from grammarbt.bt.compiler import RUNNING, Steps, compile_steps
from grammarbt.bt.model import Action, Condition

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.bt.model import BehaviorTree, Leaf

Sign: TypeAlias = tuple[int, int]
"""A pure condition: a bit of its own, and its value in the polynomials."""

Node: TypeAlias = "tuple[int, int, Test | None]"
"""What a tick does from some step on: its number, the bits of the conditions that it tests before the next call, and the
test that it begins with, if it does."""

Test: TypeAlias = "tuple[Sign, Node, Node]"
"""A condition, and what follows where it holds and where it does not."""

_PRIME = 2**127 - 1
_BYTES = 16
_CALL_BYTES = 15
"""Numbers of calls stay below the prime."""


class Fingerprints:
    """Takes fingerprints, which are the same in every process.

    Trees that behave alike share one; two others, of n leaves each, do with a probability of about n/2^120. Trees so
    tangled that asking no condition twice takes more than `MAX_NODES` nodes share one only where they go on alike after
    each leaf.

    Args:
        is_pure: whether a condition draws no randomness and changes only when an action runs.
    """

    def __init__(self, is_pure: Callable[[Condition], bool]) -> None:
        self._is_pure = is_pure
        self._signs: dict[str, Sign | bytes] = {}
        self._ends = [_call(end, 0, 0, 0) for end in (b"running", b"failure", b"success")]

    def __call__(self, tree: BehaviorTree) -> bytes:
        """A tree's fingerprint, of 16 bytes.

        Raises:
            DomainError: nested parallel nodes need more than `MAX_STEPS` steps.
        """
        try:
            number, _, _ = self._start(compile_steps(tree))
        except TooLargeError:
            return Fingerprints(none_pure)(tree)
        return number.to_bytes(_BYTES, "big")

    def _start(self, steps: Steps) -> Node:
        """What a tick does from the first step on."""
        nodes = self._ends[:1] * len(steps.steps) + self._ends  # ends at -3, -2 and -1, as steps name them
        signs = self._signs
        for at, (leaf, _, success, failure, running) in enumerate(steps.steps):
            text = leaf.text
            sign = signs[text] if text in signs else self._meet(leaf)
            if isinstance(sign, tuple):
                nodes[at] = _test_once(sign, nodes[success], nodes[failure])
            else:
                after = running if isinstance(leaf, Action) else RUNNING
                nodes[at] = _call(sign, nodes[success][0], nodes[failure][0], nodes[after][0])
        return nodes[steps.first]

    def _meet(self, leaf: Leaf) -> Sign | bytes:
        """What stands for a leaf that was never met before."""
        text = leaf.text.encode()
        pure = isinstance(leaf, Condition) and self._is_pure(leaf)
        sign = self._signs[leaf.text] = (1 << len(self._signs), _call(text, 0, 0, 0)[0]) if pure else text
        return sign


def _test_once(sign: Sign, true: Node, false: Node) -> Node:
    """A test of a condition of which nothing is known, but of which more may follow."""
    bit = sign[0]
    if true[1] & bit:
        true = _given(bit, true, holds=True)
    if false[1] & bit:
        false = _given(bit, false, holds=False)
    return _test(sign, true, false)


def _test(sign: Sign, true: Node, false: Node) -> Node:
    won, lost = true[0], false[0]
    if won == lost:
        return true
    bit, point = sign
    return (lost + point * (won - lost)) % _PRIME, true[1] | false[1] | bit, (sign, true, false)


def _given(bit: int, node: Node, *, holds: bool) -> Node:
    """What a tick does where it is known whether a condition holds.

    Raises:
        TooLargeError: it would do too many different things.
    """
    if node[1].bit_count() > MAX_CONDITIONS:
        raise TooLargeError
    known: dict[int, Node] = {}

    def found(node: Node) -> Node:
        number, tested, test = node
        if test is None or not tested & bit:
            return node
        sign, true, false = test
        if sign[0] == bit:
            return true if holds else false
        if number not in known:
            if len(known) >= MAX_NODES:
                raise TooLargeError
            known[number] = _test(sign, found(true), found(false))
        return known[number]

    return found(node)


def text_fingerprint(text: str) -> bytes:
    """Of a tree in the one-line notation, for who cares about more than behaviour."""
    return blake2b(text.encode(), digest_size=_BYTES).digest()


def _call(leaf: bytes, success: int, failure: int, running: int) -> Node:
    """A leaf, and what follows its answers, as a number that looks random and depends on these alone."""
    data = b"%b\n%x\n%x\n%x" % (leaf, success, failure, running)
    return int.from_bytes(blake2b(data, digest_size=_CALL_BYTES).digest(), "big"), 0, None
