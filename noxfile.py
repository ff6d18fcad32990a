"""Sessions: the whole suite, each plugin with only the core beside it, the linters, the docs, and the wheels."""

import tomllib
from pathlib import Path

import nox

PYTHONS = ["3.11", "3.12", "3.13"]
PLUGINS = sorted(path.name for path in Path("plugins").iterdir() if (path / "pyproject.toml").exists())
SEARCHERS = ("dagmcts", "compose", "random")

nox.options.sessions = ["tests", "lint", "docs"]


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """The whole suite."""
    session.install("-r", "requirements-dev.txt")
    session.run("pytest", "-n", "2", *session.posargs)


@nox.session(python=PYTHONS[0])
@nox.parametrize("name", PLUGINS)
def plugin(session: nox.Session, name: str) -> None:
    """One plugin's tests with only the core beside it, and what the plugin can use."""
    project = tomllib.loads(Path("plugins", name, "pyproject.toml").read_text())["project"]
    extras = ",".join(project.get("optional-dependencies", ()))
    session.install("-c", "constraints.txt", ".[test]", f"./plugins/{name}" + (f"[{extras}]" if extras else ""))
    session.run("pytest", f"plugins/{name}", *session.posargs)


@nox.session(python=PYTHONS[0])
def lint(session: nox.Session) -> None:
    """Ruff with all rules, and mypy --strict."""
    session.install("-r", "requirements-dev.txt")
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")
    session.run("mypy")


@nox.session(python=PYTHONS[0])
def docs(session: nox.Session) -> None:
    """The pages, with every warning an error."""
    session.install("-r", "requirements-dev.txt")
    session.run("sphinx-build", "-W", "-q", "docs", "docs/_build")


@nox.session(python=PYTHONS)
def wheels(session: nox.Session) -> None:
    """Source distributions, wheels built from them, and the main job in an environment that knows no checkout."""
    folder = Path(session.create_tmp()).absolute()
    session.install("build", "hatchling")
    for project in (".", *(f"plugins/{name}" for name in PLUGINS)):
        session.run("python", "-m", "build", "--no-isolation", "--outdir", str(folder), project, silent=True)
    found = [str(path) for path in sorted(folder.glob("*.whl"))]
    session.install("-c", "constraints.txt", *found)
    session.chdir(folder)
    for searcher in SEARCHERS:
        session.run("grammarbt", "run", "--searcher", searcher, "--budget", "300", "--validation", "50", "--quiet")
    session.run("grammarbt", "grammar", "count", "marine", "--domain", "marine")
    session.run("grammarbt", "--strict-plugins", "plugins")
