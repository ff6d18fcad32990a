"""Making an environment: quick to step, and every mistake told in one line."""

from __future__ import annotations

import sys
import warnings
from contextlib import redirect_stdout
from importlib import import_module
from typing import TYPE_CHECKING, Any

import gymnasium
from attrs import frozen
from gymnasium import error, spaces
from gymnasium.wrappers import OrderEnforcing, TimeLimit

from grammarbt.errors import DomainError, did_you_mean
from grammarbt_gymnasium.options import read_options

if TYPE_CHECKING:
    from grammarbt_gymnasium.parameters import GymnasiumParameters

PACKAGES = {"MiniGrid": "minigrid", "BabyAI": "minigrid", "ALE": "ale_py"}
"""Packages whose import registers the environments with such a name, where gymnasium does not do it by itself."""

ENDLESS = 1_000
"""Steps of an episode where neither the user nor the environment sets a limit."""


@frozen(eq=False)
class Environment:
    """An environment made ready.

    Attributes:
        env: without the wrappers that only check or count.
        name: its id without name space and version: `CartPole`.
        max_steps: after which an episode ends in any case.
        actions: what can be done in a step.
    """

    env: gymnasium.Env[Any, Any]
    name: str
    max_steps: int
    actions: spaces.Discrete[Any]


def make_environment(parameters: GymnasiumParameters) -> Environment:
    """The environment that the parameters name.

    Raises:
        DomainError: there is none of that name, it does not start, or its actions are not discrete.
    """
    env = _made(parameters.env, read_options(parameters.options))
    actions = env.action_space
    if not isinstance(actions, spaces.Discrete):
        message = f"the actions of {parameters.env} are not discrete: {actions}"
        raise DomainError(message, "choose an environment with Discrete actions, for example CartPole-v1")
    spec = env.spec
    name, limit = (spec.name, spec.max_episode_steps) if spec else (parameters.env, None)
    return Environment(_unwrapped(env), name, parameters.max_steps or limit or ENDLESS, actions)


def _made(name: str, options: dict[str, Any]) -> gymnasium.Env[Any, Any]:
    try:
        return _quietly_made(name, options)
    except (error.UnregisteredEnv, error.DeprecatedEnv) as problem:
        known = did_you_mean(name, gymnasium.registry)
        raise DomainError(f"there is no environment {name!r}: {_line(problem)}", known) from None
    except (error.DependencyNotInstalled, ImportError) as problem:
        raise DomainError(f"{name} needs a package that is not installed: {_line(problem)}", _install(name)) from None
    except Exception as problem:
        hint = "see the environment's documentation for its options"
        raise DomainError(f"{name} does not start: {type(problem).__name__}: {_line(problem)}", hint) from problem


def _quietly_made(name: str, options: dict[str, Any]) -> gymnasium.Env[Any, Any]:
    """What a simulator prints when it starts is no result, and what its packages deprecate is not the user's."""
    with redirect_stdout(sys.stderr), warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        package = _package_of(name)
        if package:
            import_module(package)
        return gymnasium.make(name, disable_env_checker=True, **options)


def _package_of(name: str) -> str | None:
    """The package that registers the environment, unless that is gymnasium."""
    module, colon, _ = name.partition(":")
    return module if colon else PACKAGES.get(name.replace("/", "-").partition("-")[0])


def _install(name: str) -> str:
    package = _package_of(name) or "box2d"  # what else gymnasium's own environments need
    extra = package in {"box2d", "minigrid"}
    return f"pip install 'grammarbt-gymnasium[{package}]'" if extra else f"pip install {package}"


def _unwrapped(env: gymnasium.Env[Any, Any]) -> gymnasium.Env[Any, Any]:
    """Without the outermost wrappers that do what the domain does itself."""
    while isinstance(env, TimeLimit | OrderEnforcing):
        env = env.env
    return env


def _line(problem: BaseException) -> str:
    return " ".join(str(problem).split()).rstrip(".")
