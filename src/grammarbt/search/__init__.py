"""Searching a language of trees: the protocol, and the building blocks that searchers share."""

from grammarbt.search.annealing import AnnealedSearch
from grammarbt.search.bandits import Arm, Bandit, BanditName, ThresholdAscent, Ucb1, make_bandit
from grammarbt.search.base import Evaluation, EvaluationStatus, Proposal, SearchContext, Searcher, Snapshotting
from grammarbt.search.batches import Batches, BatchSearcher, Scenarios, Strategy, Width
from grammarbt.search.behaviours import behaviour_of
from grammarbt.search.blocks import Behaviour, BlockDag, BlockNode, Piece, Stream, piece_of
from grammarbt.search.climb import Climb
from grammarbt.search.climbparameters import ClimbParameters
from grammarbt.search.derivations import Step, block_derivations, complete, end_of, leftmost, position_of, rearranged
from grammarbt.search.derivationtree import DerivationTree
from grammarbt.search.edits import Edits
from grammarbt.search.evolution import Evolution, EvolutionParameters
from grammarbt.search.fame import HallOfFame
from grammarbt.search.general import GeneralSearch, search_any_grammar
from grammarbt.search.idle import IdleElements
from grammarbt.search.listmoves import ListNeighbours, ListParts
from grammarbt.search.listspace import ListSpace, block_dags
from grammarbt.search.moves import Moves, pick
from grammarbt.search.race import Runner, closes, differences, judge, next_stage
from grammarbt.search.rootlist import ListedTree, RootList
from grammarbt.search.rows import Item, Row, Rows
from grammarbt.search.scoring import Score, Scorer
from grammarbt.search.short import ShortFirst
from grammarbt.search.site import Site
from grammarbt.search.smallest import smallest_first
from grammarbt.search.space import Around, EditSpace, Memory, Neighbour, Space
from grammarbt.search.states import State, States, Transition, Walk
from grammarbt.search.trim import reached_positions, trimmed

__all__ = [
    "AnnealedSearch",
    "Arm",
    "Around",
    "Bandit",
    "BanditName",
    "BatchSearcher",
    "Batches",
    "Behaviour",
    "BlockDag",
    "BlockNode",
    "Climb",
    "ClimbParameters",
    "DerivationTree",
    "EditSpace",
    "Edits",
    "Evaluation",
    "EvaluationStatus",
    "Evolution",
    "EvolutionParameters",
    "GeneralSearch",
    "HallOfFame",
    "IdleElements",
    "Item",
    "ListNeighbours",
    "ListParts",
    "ListSpace",
    "ListedTree",
    "Memory",
    "Moves",
    "Neighbour",
    "Piece",
    "Proposal",
    "RootList",
    "Row",
    "Rows",
    "Runner",
    "Scenarios",
    "Score",
    "Scorer",
    "SearchContext",
    "Searcher",
    "ShortFirst",
    "Site",
    "Snapshotting",
    "Space",
    "State",
    "States",
    "Step",
    "Strategy",
    "Stream",
    "ThresholdAscent",
    "Transition",
    "Ucb1",
    "Walk",
    "Width",
    "behaviour_of",
    "block_dags",
    "block_derivations",
    "closes",
    "complete",
    "differences",
    "end_of",
    "judge",
    "leftmost",
    "make_bandit",
    "next_stage",
    "pick",
    "piece_of",
    "position_of",
    "reached_positions",
    "rearranged",
    "search_any_grammar",
    "smallest_first",
    "trimmed",
]
