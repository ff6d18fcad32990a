"""What every domain must keep to, so that runs can be repeated, compared and trusted.

Each check raises `NonconformityError` with the case that shows the fault and what to do about it.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from grammarbt.bt import BehaviorTree, Condition, Fallback, Not, Sequence, compile_policy, format_tree, leaves
from grammarbt.bt.vocabulary import ActionType
from grammarbt.domain import Frame, Returns, Watchable
from grammarbt.domain.playthrough import WatchableDomain
from grammarbt.testing.subjects import DomainSubject
from grammarbt.testing.verdicts import Check, NonconformityError, require, untouched_randomness

_FEW = 3
_NO_EPISODES = "the domain has no episode()"


def check_language_has_trees(subject: DomainSubject) -> str | None:
    """The default grammar can be bound to the vocabulary, and every reference uses leaves of it."""
    require(
        bool(subject.domain.vocabulary.leaves), "the vocabulary is empty", "declare groups of actions and conditions"
    )
    for tree in subject.trees:
        compile_policy(tree, subject.domain.vocabulary.index)
    return None


def check_outcome_has_the_right_shape(subject: DomainSubject) -> str | None:
    """`simulate` gives one return per scenario, and one count of ticks per leaf of the tree."""
    for tree in subject.trees:
        outcome = subject.simulate(tree)
        returns, ticks = np.shape(outcome.returns), np.shape(outcome.ticks)
        wanted = (subject.episodes,), (len(leaves(tree)),)
        require(
            (returns, ticks) == wanted,
            f"{format_tree(tree)} on {subject.episodes} scenarios gave returns of shape {returns} and ticks of shape "
            f"{ticks}, not {wanted[0]} and {wanted[1]}",
            "count ticks per occurrence of a leaf in the tree, left to right, over all episodes",
        )
        require(
            bool(np.all(np.asarray(outcome.ticks) >= 0)) and int(np.asarray(outcome.ticks)[0]) > 0,
            f"{format_tree(tree)} was ticked {np.asarray(outcome.ticks).tolist()} times",
            "the leftmost leaf is ticked at least once in every episode, and no leaf less than 0 times",
        )
    return None


def check_returns_are_finite_and_in_range(subject: DomainSubject) -> str | None:
    """No NaN, no infinity, and nothing outside `return_range`, where the domain declares one."""
    low, high = getattr(subject.domain, "return_range", (-np.inf, np.inf))
    for tree in subject.trees:
        returns = np.asarray(subject.simulate(tree).returns, dtype=np.float64)
        bad = returns[~(np.isfinite(returns) & (returns >= low) & (returns <= high))]
        require(
            not len(bad),
            f"{format_tree(tree)} returned {bad[:1].tolist()}, which is not a number from {low} to {high}",
            "a failed episode has a low return, not NaN; widen return_range if it is wrong",
        )
    return None


def check_same_scenario_same_return(subject: DomainSubject) -> str | None:
    """A scenario fixes the world and all its noise: alone or among others, in whatever order, on whatever instance."""
    for tree in subject.trees:
        before = _returns(subject, tree)
        backwards = np.asarray(subject.simulate(tree, subject.scenarios[::-1].copy()).returns)[::-1]
        alone = np.array(
            [float(subject.simulate(tree, subject.scenarios[at : at + 1]).returns[0]) for at in range(_FEW)]
        )
        anew = np.asarray(subject.simulate(tree, domain=subject.make()).returns)
        _require_equal(tree, before, _returns(subject, tree), "simulated twice in a row")
        _require_equal(tree, before, backwards, "with its scenarios in reverse order")
        _require_equal(tree, before[:_FEW], alone, "with each scenario alone")
        _require_equal(tree, before, anew, "on another instance of the domain")
    return None


def check_same_return_in_another_process(subject: DomainSubject) -> str | None:
    """Worker processes, other machines and tomorrow's run see the same worlds; and every episode ends."""
    here = [_returns(subject, tree) for tree in subject.trees]
    for hash_seed in (1, 2):
        there = subject.elsewhere(subject.trees, hash_seed)
        for tree, mine, theirs in zip(subject.trees, here, there, strict=True):
            _require_equal(tree, mine, np.array(theirs), f"in a new process with PYTHONHASHSEED={hash_seed}")
    return None


def check_conditions_have_no_side_effects(subject: DomainSubject) -> str | None:
    """Asking a condition that is declared pure changes nothing, whether it holds or not."""
    if subject.domain.depends_on == "tree":
        return "the return depends on the tree itself, so trees cannot be compared by behaviour"
    vocabulary = subject.domain.vocabulary
    conditions = [leaf for leaf in vocabulary.leaves if isinstance(leaf, Condition) and vocabulary.is_pure(leaf)]
    for tree in subject.trees[:_FEW]:
        before = _returns(subject, tree)
        for condition in conditions:
            asked = Sequence((Fallback((condition, Not(condition))), tree))
            _require_equal(
                tree, before, _returns(subject, asked), f"with ({condition.name}) asked first, which is declared pure"
            )
    return None if conditions else "no condition is declared pure"


def check_global_randomness_is_untouched(subject: DomainSubject) -> str | None:
    """Random numbers come from the scenario alone, and nobody else's are used up."""
    advice = "make a generator from the scenario: numpy.random.default_rng(scenario)"
    with untouched_randomness("simulating", advice):
        for tree in subject.trees[:_FEW]:
            subject.simulate(tree)
    return None


def check_reference_beats_idle(subject: DomainSubject) -> str | None:
    """The first reference does better than a tree that never acts; else there is nothing to learn."""
    conditions = [leaf for leaf in subject.domain.vocabulary.leaves if isinstance(leaf, Condition)]
    if not conditions or not subject.domain.references:
        return "there is no reference" if conditions else "there is no condition to make an idle tree of"
    best = float(np.mean(_returns(subject, subject.trees[0])))
    idle = float(np.mean(_returns(subject, conditions[0])))
    require(
        best > idle,
        f"the reference {subject.domain.references[0].name!r} returns {best:g}, doing nothing {idle:g}",
        "check the sign of the reward, and that the reference does what it is meant to",
    )
    return None


def check_episode_is_the_one_scored(subject: DomainSubject) -> str | None:
    """What `episode` shows ends with the return that `simulate` gives, and counts the same ticks."""
    domain = subject.domain
    if not isinstance(domain, Watchable):
        return _NO_EPISODES
    advice = "derive both from the same world and the same draws"
    for tree, frames in _watched(domain, subject):
        outcome = subject.simulate(tree, subject.scenarios[:1])
        reward, value = frames[-1].reward if frames else "no frame", float(outcome.returns[0])
        require(reward == value, f"{format_tree(tree)}: the episode ends with {reward}, simulate gives {value}", advice)
        ticked = np.array([occurrence for frame in frames for occurrence, _ in frame.answers], dtype=np.int64)
        shown = np.bincount(ticked, minlength=len(leaves(tree))).tolist()
        require(
            shown == np.asarray(outcome.ticks).tolist(),
            f"{format_tree(tree)}: the episode ticks leaves {shown} times, simulate {outcome.ticks}",
            advice,
        )
    return None


def check_actions_answer_as_declared(subject: DomainSubject) -> str | None:
    """An action gives only the results that its declaration allows."""
    domain = subject.domain
    if not isinstance(domain, Watchable):
        return _NO_EPISODES
    for tree, frames in _watched(domain, subject):
        kinds = [domain.vocabulary.types[leaf] for leaf in leaves(tree)]
        for occurrence, status in (answer for frame in frames for answer in frame.answers):
            kind = kinds[occurrence]
            require(
                not isinstance(kind, ActionType) or status in kind.results,
                f"[{kind.name}] answered {status.name}",
                "declare it: ActionType(..., results=frozenset({...})); trees are simplified by what is declared",
            )
    return None


DOMAIN_CHECKS: tuple[Check[DomainSubject], ...] = (
    check_language_has_trees,
    check_outcome_has_the_right_shape,
    check_returns_are_finite_and_in_range,
    check_same_scenario_same_return,
    check_same_return_in_another_process,
    check_conditions_have_no_side_effects,
    check_global_randomness_is_untouched,
    check_reference_beats_idle,
    check_episode_is_the_one_scored,
    check_actions_answer_as_declared,
)
"""Every check a domain is put to, the plainest first."""


def _watched(domain: WatchableDomain, subject: DomainSubject) -> Iterator[tuple[BehaviorTree, tuple[Frame, ...]]]:
    """The trees, each with the frames of an episode."""
    for tree in subject.trees:
        policy = compile_policy(tree, domain.vocabulary.index)
        yield tree, domain.episode(policy, int(subject.scenarios[0])).frames


def _returns(subject: DomainSubject, tree: BehaviorTree) -> Returns:
    return np.asarray(subject.simulate(tree).returns, dtype=np.float64)


def _require_equal(tree: BehaviorTree, expected: Returns, found: Returns, when: str) -> None:
    differ = np.flatnonzero(expected != found)
    if len(differ):
        at = int(differ[0])
        raise NonconformityError(
            f"{format_tree(tree)} returned {expected[at]!r} on scenario {at}, and {found[at]!r} {when}",
            "draw all that is random from a generator made from the scenario, keep no state between episodes, and never "
            "iterate over a set",
        )
