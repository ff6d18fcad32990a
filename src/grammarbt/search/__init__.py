"""Searching a language of trees: the protocol, and the building blocks that searchers share."""

from grammarbt.search.bandits import Arm, Bandit, BanditName, ThresholdAscent, Ucb1, make_bandit
from grammarbt.search.base import Evaluation, EvaluationStatus, Proposal, SearchContext, Searcher
from grammarbt.search.batches import Batches, BatchSearcher, Scenarios, Strategy, Width
from grammarbt.search.behaviours import behaviour_of
from grammarbt.search.blocks import Behaviour, BlockDag, BlockNode, Piece, piece_of
from grammarbt.search.derivations import Step, block_derivations, leftmost, position_of
from grammarbt.search.fame import HallOfFame
from grammarbt.search.race import Runner, closes, differences, judge, next_stage
from grammarbt.search.rootlist import ListedTree, RootList
from grammarbt.search.trim import reached_positions, trimmed

__all__ = [
    "Arm",
    "Bandit",
    "BanditName",
    "BatchSearcher",
    "Batches",
    "Behaviour",
    "BlockDag",
    "BlockNode",
    "Evaluation",
    "EvaluationStatus",
    "HallOfFame",
    "ListedTree",
    "Piece",
    "Proposal",
    "RootList",
    "Runner",
    "Scenarios",
    "SearchContext",
    "Searcher",
    "Step",
    "Strategy",
    "ThresholdAscent",
    "Ucb1",
    "Width",
    "behaviour_of",
    "block_derivations",
    "closes",
    "differences",
    "judge",
    "leftmost",
    "make_bandit",
    "next_stage",
    "piece_of",
    "position_of",
    "reached_positions",
    "trimmed",
]
