"""From features to conditions: the thresholds, the leaves, and how each leaf is answered."""

from __future__ import annotations

import operator
from collections.abc import Callable
from itertools import pairwise
from math import floor, isfinite, log10
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from grammarbt.domain import ConditionType
from grammarbt_gymnasium.features import Feature, Flag, Number

if TYPE_CHECKING:
    from grammarbt_gymnasium.parameters import Spacing

Floats: TypeAlias = NDArray[np.float64]
Comparison: TypeAlias = Callable[[float, float], bool]
PARAMETER = "value"


@frozen
class Question:
    """A kind of condition.

    Attributes:
        type: as the vocabulary declares it.
        compare: what its values are put to the feature with.
        feature: the feature's place.
        operands: one per combination of arguments, in their order.
    """

    type: ConditionType
    compare: Comparison
    feature: int
    operands: tuple[float, ...]


def questions_about(feature: Feature, place: int, seen: Floats, n: int, spacing: Spacing) -> tuple[Question, ...]:
    """What trees may ask about a feature.

    Args:
        feature: what is asked about.
        place: of the feature in a view.
        seen: its values in a roll-out, (steps,).
        n: thresholds of a number.
        spacing: how they are spread.
    """
    if isinstance(feature, Flag):
        return (Question(ConditionType(feature.name, f"{feature.name} holds."), operator.eq, place, (1.0,)),)
    if isinstance(feature, Number):
        values = thresholds(feature, seen, n, spacing)
        return (_above(feature.name, place, tuple(str(value) for value in values), values),) if values else ()
    numbers = tuple(float(number) for number in range(len(feature.labels)))
    help_ = f"{feature.name} is the one named."
    kind = ConditionType(f"{feature.name} is", help_, parameters=((PARAMETER, feature.labels),))
    equal = Question(kind, operator.eq, place, numbers)
    return (equal, _above(feature.name, place, feature.labels[:-1], numbers[:-1])) if feature.ordered else (equal,)


def _above(name: str, place: int, labels: tuple[str, ...], values: tuple[float, ...]) -> Question:
    help_ = f"{name} is above the value."
    return Question(
        ConditionType(f"{name} above", help_, parameters=((PARAMETER, labels),)), operator.gt, place, values
    )


def thresholds(feature: Number, seen: Floats, n: int, spacing: Spacing) -> tuple[float, ...]:
    """At most n thresholds in ascending order, rounded to about the distance between them.

    Where few values came up, such as 0 and 1, the thresholds lie half-way between them.
    """
    distinct = np.unique(seen)
    if len(distinct) <= n:
        return tuple((low + high) / 2 for low, high in pairwise(distinct.tolist()))
    cuts = _grid(feature, seen, n) if spacing == "grid" else _quantiles(feature, seen, n)
    digits = -floor(log10(max((cuts[-1] - cuts[0]) / n, np.finfo(float).tiny)))
    return tuple(dict.fromkeys(round(cut, digits) + 0.0 for cut in cuts.tolist()))  # + 0.0 makes -0.0 plain


def _grid(feature: Number, seen: Floats, n: int) -> Floats:
    """Equal steps between the bounds, or what was seen where there are none."""
    low = feature.low if isfinite(feature.low) else float(seen.min())
    high = feature.high if isfinite(feature.high) else float(seen.max())
    return np.linspace(low, high, n + 2)[1:-1]


def _quantiles(feature: Number, seen: Floats, n: int) -> Floats:
    """As many values seen between one threshold and the next.

    What is symmetric about zero, as velocities and angles are, gets thresholds that are so too: quantiles of the size.
    """
    if feature.low != -feature.high:
        return np.quantile(seen, np.arange(1, n + 1) / (n + 1))
    half = np.quantile(np.abs(seen), np.arange(1, n // 2 + 1) / (n // 2 + 1))
    return np.concatenate([-half[::-1], np.zeros(n % 2), half])
