"""For people who write domains and searchers: conformance checks, and what their tests share."""

from grammarbt.testing.domains import DOMAIN_CHECKS
from grammarbt.testing.playthroughs import Playthroughs
from grammarbt.testing.puzzles import Puzzle, errands, letters
from grammarbt.testing.searchers import SEARCHER_CHECKS
from grammarbt.testing.subjects import DomainSubject, SearcherSubject
from grammarbt.testing.suites import DomainConformance, SearcherConformance
from grammarbt.testing.trees import tally, trees_over, wild_tree
from grammarbt.testing.verdicts import Check, NonconformityError, Verdict, verdicts

__all__ = [
    "DOMAIN_CHECKS",
    "SEARCHER_CHECKS",
    "Check",
    "DomainConformance",
    "DomainSubject",
    "NonconformityError",
    "Playthroughs",
    "Puzzle",
    "SearcherConformance",
    "SearcherSubject",
    "Verdict",
    "errands",
    "letters",
    "tally",
    "trees_over",
    "verdicts",
    "wild_tree",
]
