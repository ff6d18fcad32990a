"""Sessions: the whole suite, each plugin with only the core beside it, and the linters."""

from pathlib import Path

import nox

PYTHONS = ["3.11", "3.12", "3.13"]
PLUGINS = sorted(path.name for path in Path("plugins").iterdir() if (path / "pyproject.toml").exists())

nox.options.sessions = ["tests", "lint"]


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """The whole suite."""
    session.install("-r", "requirements-dev.txt")
    session.run("pytest", "-n", "2", *session.posargs)


@nox.session(python=PYTHONS[0])
@nox.parametrize("name", PLUGINS)
def plugin(session: nox.Session, name: str) -> None:
    """One plugin's tests with only the core beside it."""
    session.install("-c", "constraints.txt", ".[test]", f"./plugins/{name}")
    session.run("pytest", f"plugins/{name}", *session.posargs)


@nox.session(python=PYTHONS[0])
def lint(session: nox.Session) -> None:
    """Ruff with all rules, and mypy --strict."""
    session.install("-r", "requirements-dev.txt")
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")
    session.run("mypy")
