"""What every searcher must keep to, so that a run can wire it to any domain, and go on after it was stopped.

Each check raises `NonconformityError` with the case that shows the fault and what to do about it.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from functools import partial
from math import isfinite
from pathlib import Path
from typing import get_args

from grammarbt.bt import BehaviorTree, format_tree, parse
from grammarbt.grammar import NotInLanguageError, parse_tree
from grammarbt.search import Evaluation, EvaluationStatus
from grammarbt.testing.subjects import SearcherSubject
from grammarbt.testing.trials import TrialRun
from grammarbt.testing.verdicts import Check, NonconformityError, require, untouched_randomness
from grammarbt.testing.worlds import INFINITE

_WIDTHS = (1, 7, 32)
_FEW = 5
_JOURNAL = "journal.jsonl"


def check_proposals_are_words_of_the_language(subject: SearcherSubject) -> str | None:
    """Every proposal is a tree of the language, and its derivation, where it gives one, derives it."""
    run = TrialRun.of(subject)
    for proposal in run.go(subject.budget):
        _require_word(run, proposal.tree, "proposed")
        if proposal.derivation is not None:
            derived = run.grammar.tree(run.grammar.derive(proposal.derivation))
            require(
                derived == proposal.tree,
                f"it proposed {format_tree(proposal.tree)} with a derivation of {format_tree(derived)}",
                "give the leftmost derivation of the very tree, or None",
            )
    return None


def check_asks_for_no_more_than_wanted(subject: SearcherSubject) -> str | None:
    """`ask(n)` gives at most n proposals, each of some scenarios, whatever n is."""
    for width in _WIDTHS:
        run = TrialRun.of(subject)
        for proposals in run.batches(subject.budget, width):
            require(
                len(proposals) <= width,
                f"asked for {width} proposals it gave {len(proposals)}",
                "keep the rest for the next ask",
            )
            for proposal in proposals:
                require(
                    0 <= proposal.start < proposal.stop,
                    f"it proposed the scenarios {proposal.start} to {proposal.stop}",
                    "count scenarios from 0; stop is exclusive and above start",
                )
    return None


def check_candidates_are_trees_it_believes_in(subject: SearcherSubject) -> str | None:
    """After a search `candidates(n)` gives 1 to n different trees of the language, and metrics are numbers."""
    run = TrialRun.of(subject)
    list(run.go(subject.budget))
    found = list(run.searcher.candidates(_FEW))
    require(
        1 <= len(found) <= _FEW and len(set(found)) == len(found),
        f"candidates({_FEW}) gave {len(found)} trees, {len(set(found))} of them different",
        "give the best trees you were told of, best first, each once",
    )
    for tree in found:
        _require_word(run, tree, "believes in")
    for key, value in run.searcher.metrics().items():
        require(isfinite(value), f"metric {key!r} is {value!r}", "metrics are numbers that can be drawn as curves")
    return None


def check_copes_with_failed_evaluations(subject: SearcherSubject) -> str | None:
    """A simulator that fails with every third tree does not stop the search."""
    for status in get_args(EvaluationStatus)[1:]:
        run = TrialRun.of(subject)
        proposed = sum(1 for _ in run.go(subject.budget, partial(_failing, status)))
        require(
            proposed > _FEW,
            f"after evaluations of status {status!r} it proposed nothing more",
            "treat a failed evaluation as a bad return, and go on",
        )
        require(
            bool(run.searcher.candidates(1)),
            f"after some evaluations of status {status!r} it believes in no tree",
            "candidates are chosen among the evaluations that did not fail",
        )
    return None


def check_copes_with_constant_returns(subject: SearcherSubject) -> str | None:
    """Where every tree returns the same, no division by a spread of zero stops the search."""
    for value in (0.0, -7.5, 1e9):
        run = TrialRun.of(subject)
        for _ in run.go(subject.budget, constant=value):
            pass
        require(
            bool(run.searcher.candidates(1)),
            f"after {run.episodes} returns of {value:g} it believes in no tree",
            "a constant return is a return",
        )
    return None


def check_copes_with_an_infinite_language(subject: SearcherSubject) -> str | None:
    """A recursive grammar without limits is searched, not listed."""
    run = TrialRun.of(subject, INFINITE)
    proposed = sum(1 for _ in run.go(min(subject.budget, 100)))
    require(proposed > 0, "it proposed nothing in a language without end", "sample where you cannot enumerate")
    return None


def check_comes_to_an_end(subject: SearcherSubject) -> str | None:
    """In a language of few words it says that nothing is left, or repeats itself at no cost; it never hangs."""
    with tempfile.TemporaryDirectory() as folder:
        grammar = Path(folder) / "tiny.grammar"
        grammar.write_text(subject.tiny, encoding="utf-8")
        subject.run(Path(folder) / "run", "--grammar", str(grammar), "--budget", "1000", "--trials", "20000")
    return None


def check_same_seed_same_run(subject: SearcherSubject) -> str | None:
    """The journal has the same bytes whatever PYTHONHASHSEED is."""
    with tempfile.TemporaryDirectory() as folder:
        again = subject.run(Path(folder) / "run", "--batch", "4", hash_seed=2)
        _require_same(
            subject, again, "under another PYTHONHASHSEED", "never iterate over a set, or sort by hash() or id()"
        )
    return None


def check_worker_count_does_not_matter(subject: SearcherSubject) -> str | None:
    """At an equal batch, one worker or two, the journal has the same bytes."""
    with tempfile.TemporaryDirectory() as folder:
        again = subject.run(Path(folder) / "run", "--batch", "4", "--workers", "2", hash_seed=1)
        _require_same(subject, again, "with two workers", "depend on the order asked, not on the order of arrival")
    return None


def check_replay_equals_one_go(subject: SearcherSubject) -> str | None:
    """A run cut in the middle and resumed ends with the journal of the run that was not."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in subject.finished_run.items():
            (Path(folder) / name).write_bytes(content)
        lines = subject.finished_run[_JOURNAL].splitlines(keepends=True)
        (Path(folder) / _JOURNAL).write_bytes(b"".join(lines[: len(lines) // 2]))
        subject.command_line(["resume", folder, "--json"], hash_seed=1)
        _require_same(
            subject, Path(folder), "after an interruption", "keep no state outside of what ask and tell bring"
        )
    return None


def check_global_randomness_is_untouched(subject: SearcherSubject) -> str | None:
    """All randomness comes from the generator in the context."""
    with untouched_randomness("it", "use context.rng alone"):
        for _ in TrialRun.of(subject).go(subject.budget):
            pass
    return None


def check_begins_from_the_start_tree(subject: SearcherSubject) -> str | None:
    """A start tree is among the first trees proposed."""
    start = parse(subject.domain.references[0].tree)
    run = TrialRun.of(subject, start=start)
    first = [proposal.tree for proposal in run.go(min(subject.budget, 100))]
    require(
        start in first,
        f"context.start was {format_tree(start)}, and not among the first {len(first)} proposals",
        "propose context.start first, when there is one",
    )
    return None


SEARCHER_CHECKS: tuple[Check[SearcherSubject], ...] = (
    check_proposals_are_words_of_the_language,
    check_asks_for_no_more_than_wanted,
    check_candidates_are_trees_it_believes_in,
    check_begins_from_the_start_tree,
    check_copes_with_failed_evaluations,
    check_copes_with_constant_returns,
    check_copes_with_an_infinite_language,
    check_comes_to_an_end,
    check_global_randomness_is_untouched,
    check_same_seed_same_run,
    check_worker_count_does_not_matter,
    check_replay_equals_one_go,
)
"""Every check a searcher is put to, the plainest first."""


def _require_word(run: TrialRun, tree: BehaviorTree, verb: str) -> None:
    try:
        parse_tree(run.grammar, tree)
    except NotInLanguageError as error:
        raise NonconformityError(
            f"it {verb} {format_tree(tree)}, which is not in the language: {error.message}",
            "build trees with the grammar: derive, apply, extended",
        ) from None


def _failing(status: EvaluationStatus, told: Sequence[Evaluation]) -> list[Evaluation]:
    """About every third tree fails, always the same ones."""
    bad = {at for at in range(len(told)) if len(format_tree(told[at].proposal.tree)) % 3 == 0}
    return [Evaluation(each.proposal, (), (), status, "planted") if at in bad else each for at, each in enumerate(told)]


def _require_same(subject: SearcherSubject, again: Path, when: str, advice: str) -> None:
    """The run in that folder has the journal of the subject's finished run."""
    mine, theirs = subject.finished_run[_JOURNAL].splitlines(), (again / _JOURNAL).read_bytes().splitlines()
    differ = next((at for at, pair in enumerate(zip(mine, theirs, strict=False)) if pair[0] != pair[1]), None)
    if differ is None and len(mine) != len(theirs):
        differ = min(len(mine), len(theirs))
    require(differ is None, f"event {(differ or 0) + 1} of the journal is another one {when}", advice)
