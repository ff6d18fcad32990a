"""The checks as pytest classes: subclass one, name your component, and every check is a test.

class TestCorridor(DomainConformance):
    subject = DomainSubject("corridor.py:Corridor")
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from grammarbt.testing.domains import DOMAIN_CHECKS
from grammarbt.testing.searchers import SEARCHER_CHECKS
from grammarbt.testing.verdicts import Check, Subject, name_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from grammarbt.testing.subjects import DomainSubject, SearcherSubject


class DomainConformance:
    """A test per check of `grammarbt.testing.domains`."""

    subject: ClassVar[DomainSubject]


class SearcherConformance:
    """A test per check of `grammarbt.testing.searchers`."""

    subject: ClassVar[SearcherSubject]


def _test_of(check: Check[Subject]) -> Callable[..., None]:
    def test(self: object) -> None:
        reason = check(self.subject)  # type: ignore[attr-defined]  # declared by the classes above
        if reason is not None:
            import pytest  # noqa: PLC0415 - the checks themselves need no pytest

            pytest.skip(reason)

    test.__doc__ = check.__doc__
    return test


def _add_tests(suite: type, checks: Iterable[Check[Subject]]) -> None:
    for check in checks:
        setattr(suite, f"test_{name_of(check).replace(' ', '_')}", _test_of(check))


_add_tests(DomainConformance, DOMAIN_CHECKS)
_add_tests(SearcherConformance, SEARCHER_CHECKS)
