"""The loop: ask the searcher, evaluate, write it down, tell the searcher."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, TypeVar

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel
from grammarbt.bt import Sequence as SequenceNode
from grammarbt.errors import GrammarBTError, RunError, SearcherError
from grammarbt.run.select import FIRST_SELECTION_SCENARIO
from grammarbt.run.stopping import Reason, Tally, reason_to_stop
from grammarbt.search import Proposal, Searcher

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.run.evaluate import Evaluator, Trial
    from grammarbt.run.spec import RunSpec

Answer = TypeVar("Answer")

MAX_FAILURES = 25
"""Trials that may fail one after the other."""

_NODE = (Fallback, SequenceNode, Parallel, Not, Action, Condition)


class Follower(Protocol):
    """Who follows a search."""

    @property
    def seconds(self) -> float:
        """How long the search has taken."""
        ...

    def evaluated(self, trials: Sequence[Trial]) -> None:
        """A batch was evaluated; the searcher does not know it yet."""
        ...

    def learned(self) -> None:
        """The searcher was told, and is about to be asked again."""
        ...


class AskTellLoop:
    """Lets a searcher spend its episodes.

    Args:
        searcher: proposes and learns.
        evaluator: simulates.
        spec: when to stop, and how many to ask for at a time.
        tally: where the search stands; it is kept up to date.
        follower: hears of each batch.
    """

    def __init__(
        self, searcher: Searcher, evaluator: Evaluator, spec: RunSpec, tally: Tally, follower: Follower
    ) -> None:
        self._searcher = searcher
        self._evaluator = evaluator
        self._spec = spec
        self._tally = tally
        self._follower = follower
        self._failures: list[Trial] = []

    def run(self) -> Reason:
        """Go on until something stops the search.

        Raises:
            SearcherError: the searcher broke, or broke the protocol.
            RunError: too many trials failed, one after the other.
        """
        reason = self._stopped() if self._tally.trials else None
        while reason is None:
            reason = self._batch() or self._stopped()
        return reason

    def _batch(self) -> Reason | None:
        left = self._spec.search_episodes - self._tally.episodes
        proposals = self._ask(int(min(self._spec.batch, left, self._trials_left)))
        if not proposals:
            return "exhausted"
        replaying = self._evaluator.replay.going
        trials = self._evaluator.evaluate(proposals, left)
        for trial in trials:
            self._tally.note(trial)
        self._follower.evaluated(trials)
        if len(trials) < len(proposals):
            return "budget"
        self._tell(trials)
        if not replaying:
            self._check_failures(trials)
        return None

    @property
    def _trials_left(self) -> float:
        return float("inf") if self._spec.trials is None else self._spec.trials - self._tally.trials

    def _ask(self, asked: int) -> Sequence[Proposal]:
        proposals: object = guarded("ask", lambda: self._searcher.ask(asked))
        return checked_proposals(proposals, asked)

    def _tell(self, trials: Sequence[Trial]) -> None:
        guarded("tell", lambda: self._searcher.tell([trial.evaluation for trial in trials]))
        self._follower.learned()

    def _check_failures(self, trials: Sequence[Trial]) -> None:
        """A run that goes on may try as often again: its simulator may have been repaired meanwhile."""
        for trial in trials:
            if trial.evaluation.status == "ok":
                self._failures.clear()
                continue
            self._failures.append(trial)
            if len(self._failures) >= MAX_FAILURES:
                first = self._failures[0]
                raise RunError(
                    f"{MAX_FAILURES} trials failed in a row, the first with: {first.evaluation.error}",
                    f"try its tree with 'grammarbt evaluate', then resume: {first.text}",
                )

    def _stopped(self) -> Reason | None:
        return reason_to_stop(self._spec, self._tally, self._out_of_time)

    def _out_of_time(self, seconds: float) -> bool:
        replay = self._evaluator.replay
        return replay.out_of_time if replay.going else self._follower.seconds >= seconds


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
