"""The loop: ask the searcher, evaluate, write it down, tell the searcher."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, TypeAlias, TypeVar

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel
from grammarbt.bt import Sequence as SequenceNode
from grammarbt.errors import GrammarBTError, RunError, SearcherError
from grammarbt.run.incumbent import Incumbent
from grammarbt.run.select import FIRST_SELECTION_SCENARIO
from grammarbt.search import Proposal, Searcher

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.run.evaluate import Evaluator, Trial
    from grammarbt.run.spec import RunSpec

Answer = TypeVar("Answer")
Reason: TypeAlias = Literal["budget", "trials", "seconds", "target", "exhausted", "stalled"]
"""Why a search stopped; exhausted: the searcher has nothing left, stalled: it proposes nothing new."""

_STALLED = 10_000
_MAX_FAILURES = 25
_NODE = (Action, Condition, Fallback, SequenceNode, Parallel, Not)


class AskTellLoop:
    """Lets a searcher spend its episodes.

    Args:
        searcher: proposes and learns.
        evaluator: simulates.
        spec: when to stop, and how many to ask for at a time.
        record: told of each batch, before the searcher is.

    Attributes:
        incumbent: the best tree so far.
        trials: proposals evaluated.
    """

    def __init__(
        self, searcher: Searcher, evaluator: Evaluator, spec: RunSpec, record: Callable[[Sequence[Trial]], None]
    ) -> None:
        self.incumbent = Incumbent()
        self.trials = 0
        self._searcher = searcher
        self._evaluator = evaluator
        self._spec = spec
        self._record = record
        self._started = time.monotonic()
        self._known_in_a_row = 0
        self._failed_in_a_row = 0

    def run(self) -> Reason:
        """Go on until something stops the search.

        Raises:
            SearcherError: the searcher broke, or broke the protocol.
            RunError: too many trials failed, one after the other.
        """
        while True:
            reason = self._batch() or self._stopped()
            if reason:
                return reason

    def _batch(self) -> Reason | None:
        left = self._spec.search_episodes - self._evaluator.episodes
        asked = int(min(self._spec.batch, left, self._trials_left))
        proposals = self._ask(asked)
        if not proposals:
            return "exhausted"
        trials = self._evaluator.evaluate(proposals, left)
        self._note(trials)
        self._record(trials)
        if len(trials) < len(proposals):
            return "budget"
        self._tell(trials)
        return None

    @property
    def _trials_left(self) -> float:
        return float("inf") if self._spec.trials is None else self._spec.trials - self.trials

    def _ask(self, asked: int) -> Sequence[Proposal]:
        proposals: object = guarded("ask", lambda: self._searcher.ask(asked))
        return checked_proposals(proposals, asked)

    def _tell(self, trials: Sequence[Trial]) -> None:
        guarded("tell", lambda: self._searcher.tell([trial.evaluation for trial in trials]))
        failed = next((trial for trial in trials if trial.evaluation.status != "ok"), None)
        if failed and self._failed_in_a_row >= _MAX_FAILURES and not self._evaluator.replay.going:
            raise RunError(
                f"{self._failed_in_a_row} trials failed in a row, the last with: {failed.evaluation.error}",
                "try one with 'grammarbt evaluate'",
            )

    def _note(self, trials: Sequence[Trial]) -> None:
        for trial in trials:
            self.trials += 1
            self._known_in_a_row = 0 if trial.simulated else self._known_in_a_row + 1
            if trial.evaluation.status != "ok":
                self._failed_in_a_row += 1
                continue
            self._failed_in_a_row = 0
            tree = trial.evaluation.proposal.tree
            known = self._evaluator.known(tree)
            self.incumbent.consider(tree, known, known[len(known) - trial.simulated :])

    def _stopped(self) -> Reason | None:
        spec = self._spec
        conditions: tuple[tuple[Reason, bool], ...] = (
            ("budget", self._evaluator.episodes >= spec.search_episodes),
            ("trials", spec.trials is not None and self.trials >= spec.trials),
            ("target", spec.target is not None and self.incumbent.mean >= spec.target),
            ("seconds", spec.seconds is not None and self._out_of_time(spec.seconds)),
            ("stalled", self._known_in_a_row >= _STALLED),
        )
        return next((reason for reason, holds in conditions if holds), None)

    def _out_of_time(self, seconds: float) -> bool:
        replay = self._evaluator.replay
        return replay.out_of_time if replay.going else time.monotonic() - self._started >= seconds


def guarded(method: str, call: Callable[[], Answer]) -> Answer:
    """What a searcher's method answers; a fault in it becomes one line."""
    try:
        return call()
    except GrammarBTError:
        raise
    except Exception as error:
        raise SearcherError(
            f"the searcher's {method} raised {type(error).__name__}: {error}", "--traceback shows where"
        ) from error


def checked_proposals(proposals: object, asked: int) -> Sequence[Proposal]:
    """Proposals, if a searcher's answer is at most `asked` of them.

    Raises:
        SearcherError: it is not; the message says what to change.
    """
    if not isinstance(proposals, Sequence):
        raise SearcherError(
            f"ask must return a list of proposals, not {type(proposals).__name__}", "return [] when nothing is left"
        )
    if len(proposals) > asked:
        raise SearcherError(f"ask({asked}) returned {len(proposals)} proposals", "return at most as many as asked for")
    for proposal in proposals:
        _check_proposal(proposal)
    return proposals


def _check_proposal(proposal: object) -> None:
    if not isinstance(proposal, Proposal):
        raise SearcherError(
            f"ask returned a {type(proposal).__name__} among its proposals", "wrap trees in Proposal(tree)"
        )
    if not isinstance(proposal.tree, _NODE):
        raise SearcherError(
            f"a proposal holds a {type(proposal.tree).__name__} instead of a tree",
            "use grammar.tree(form) or parse(text)",
        )
    if not 0 <= proposal.start < proposal.stop <= FIRST_SELECTION_SCENARIO:
        raise SearcherError(
            f"a proposal asks for the scenarios {proposal.start} to {proposal.stop}",
            f"start must be 0 or more, and stop greater, up to {FIRST_SELECTION_SCENARIO:,}",
        )
