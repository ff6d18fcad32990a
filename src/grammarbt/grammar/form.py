"""Sentential forms: partly derived trees.

A form's `used` holds, for each scope marker from left to right, what that scope has used up so far, one number per
constraint the scope belongs to. What is finished to the left of everything else may be dropped: the rest still knows
enough to go on.
"""

from __future__ import annotations

from typing import TypeAlias

from attrs import frozen

Used: TypeAlias = tuple[tuple[int, ...], ...]


@frozen
class SententialForm:
    """Symbol numbers with scope markers, and what each open scope has used."""

    symbols: tuple[int, ...]
    used: Used = ()

    @property
    def key(self) -> str:
        """A text that two forms share exactly if they are equal; the same in every process."""
        return f"{','.join(map(str, self.symbols))};{self.used}"
