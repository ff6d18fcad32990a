"""Conformance checks for people who write domains and searchers."""

from grammarbt.testing.domains import DOMAIN_CHECKS
from grammarbt.testing.searchers import SEARCHER_CHECKS
from grammarbt.testing.subjects import DomainSubject, SearcherSubject
from grammarbt.testing.suites import DomainConformance, SearcherConformance
from grammarbt.testing.verdicts import Check, NonconformityError, Verdict, verdicts

__all__ = [
    "DOMAIN_CHECKS",
    "SEARCHER_CHECKS",
    "Check",
    "DomainConformance",
    "DomainSubject",
    "NonconformityError",
    "SearcherConformance",
    "SearcherSubject",
    "Verdict",
    "verdicts",
]
