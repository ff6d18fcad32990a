"""Searching a language of trees: the protocol, and the building blocks that searchers share."""

from grammarbt.search.base import Evaluation, EvaluationStatus, Proposal, SearchContext, Searcher

__all__ = ["Evaluation", "EvaluationStatus", "Proposal", "SearchContext", "Searcher"]
