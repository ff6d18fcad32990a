"""What a report shows that takes simulating: the curve on fresh worlds, and what each node does."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from attrs import frozen

from grammarbt.bt import parse
from grammarbt.errors import GrammarBTError
from grammarbt.report.curves import Point, measure_curve
from grammarbt.report.entrants import domain_of
from grammarbt.run.inspection import Inspection, inspect_tree
from grammarbt.run.score import Validator

if TYPE_CHECKING:
    from grammarbt.domain import Domain
    from grammarbt.plugins import Registry
    from grammarbt.report.history import History

LEFT_OUT = "asked to simulate nothing"


@frozen
class Evidence:
    """What simulating showed, as far as it could be had.

    Attributes:
        worlds: fresh worlds per tree.
        curve: how good the incumbents were.
        reference: mean of the tree to compare with, on the same worlds.
        inspection: of the best tree.
        missing: why some of it is not there; empty if all is.
    """

    worlds: int
    curve: Sequence[Point] = ()
    reference: float | None = None
    inspection: Inspection | None = None
    missing: str = ""


def gather(history: History, registry: Callable[[], Registry], worlds: int) -> Evidence:
    """Simulate what a report shows; a domain that is broken, or gone, leaves it out and says why.

    Args:
        history: the run.
        registry: opens what makes its domain.
        worlds: fresh worlds per tree; 0 to simulate nothing.
    """
    if not worlds:
        return Evidence(worlds, missing=LEFT_OUT)
    if history.tree is None:
        return Evidence(worlds, missing="no tree has been evaluated yet")
    try:
        return _gathered(history, domain_of(history, registry()), worlds)
    except GrammarBTError as error:
        return Evidence(worlds, missing=str(error))


def _gathered(history: History, domain: Domain, worlds: int) -> Evidence:
    validator = Validator(domain, history.seed)
    budget = int(history.resolved["budget"]) if history.finished else history.episodes
    curve = measure_curve(history, validator, budget, worlds)
    other = history.reference
    reference = None if other is None else validator.score(parse(other.tree), worlds).mean
    try:
        inspection = inspect_tree(parse(history.tree or ""), domain, history.seed, worlds)
    except GrammarBTError as error:
        return Evidence(worlds, curve, reference, missing=str(error))
    return Evidence(worlds, curve, reference, inspection)
