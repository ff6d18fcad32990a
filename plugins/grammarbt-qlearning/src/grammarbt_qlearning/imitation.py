"""Imitation of the best tree: what it chose is chosen again, but for one decision."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Sequence

import numpy as np

from grammarbt.search import State
from grammarbt_qlearning.choices import Choices, Option

INSERTED = 0.5
"""How often the odd option comes before what the best tree chose, and not in its place."""


class Imitation:
    """Repeats the options that a derivation chose, for each nonterminal in their order, and does otherwise once.

    By their order, and not by the states they were chosen in: one more sub-tree makes all later states other ones, of
    which little may be known, while what comes after it can well stay as it was.

    Args:
        chosen: the nonterminals of the derivation, and the options chosen for them.
        choices: of the grammar.
        rng: chooses where to do otherwise, and what.
    """

    def __init__(self, chosen: Sequence[tuple[int, Option]], choices: Choices, rng: np.random.Generator) -> None:
        self.choices = choices
        self.rng = rng
        self.ahead: dict[int, deque[Option]] = defaultdict(deque)
        for symbol, option in chosen:
            self.ahead[symbol].append(option)
        self.until_odd = int(rng.random() * len(chosen))

    def option(self, state: State) -> Option | None:
        """What to choose now; None where nothing is left to imitate."""
        ahead, options = self.ahead[state.symbol], self.choices.options(state)
        while ahead and ahead[0] not in options:
            ahead.popleft()
        if not ahead:
            return None
        self.until_odd -= 1
        if self.until_odd != -1:
            return ahead.popleft()
        if self.rng.random() >= INSERTED:
            ahead.popleft()
        return self.choices.draw(state, self.rng)
