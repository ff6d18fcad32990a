"""Follows the tutorials from nothing, as a newcomer does, and says how long that takes.

    python benchmarks/tutorials.py                      # the README's `make run`, and every tutorial
    python benchmarks/tutorials.py first-run robot      # some of them
    python benchmarks/tutorials.py README --suite       # also `make test`

Each page gets a fresh clone of what is committed, in which nothing is installed and no download is remembered. There the
install commands of the first tutorial are typed, then all that the page says. What is printed is compared with the page,
as `tests/docs/test_pages.py` does. Times are seconds on the clock and, in parentheses, of the processors; a command of
less than a second is counted, but not listed. Reading and typing come on top.
"""

import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path

from attrs import define, field, frozen

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/docs"))
from pages import ROOT, Terminal, agrees

TUTORIALS = ROOT / "docs/tutorials"
README, FIRST = "README", "first-run"
PAGES = (README, FIRST, *sorted({path.stem for path in TUTORIALS.glob("*.md")} - {FIRST}))
OWN_SETTINGS = ("PYTHON", "VIRTUAL_ENV", "GRAMMARBT")
"""Of the environment that this program runs in; a newcomer has none of it."""

_SHELL = re.compile(r"^```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_PRINTS = re.compile(r"What it prints.*:\n\n((?:    .*\n)+)")


@frozen
class Step:
    """A command that was typed, whether it printed what the page says, and its seconds."""

    line: str
    said: str
    printed: str
    clock: float
    processors: float

    @property
    def installs(self) -> bool:
        """Whether most of the time is that of downloads."""
        return "pip install" in self.line or "venv" in self.line


@define
class Newcomer(Terminal):
    """Somebody with a fresh clone, who really installs what a page says.

    Attributes:
        environment: what programs find there.
        activated: what was sourced, and is again before each later command.
    """

    environment: Mapping[str, str] = field(factory=dict)
    activated: str = ""

    def __attrs_post_init__(self) -> None:
        """Clone, and know nothing."""
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(self.folder)], check=True)  # noqa: S607
        here = str(Path(sys.executable).parent)
        path = os.pathsep.join(place for place in os.environ["PATH"].split(os.pathsep) if place != here)
        kept = {name: value for name, value in os.environ.items() if not name.startswith(OWN_SETTINGS)}
        self.environment = kept | {"PATH": path, "PIP_NO_CACHE_DIR": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}

    def run(self, line: str) -> tuple[str, str]:
        """As it stands. Pages do not show what pip says while all goes well."""
        if line.startswith(". "):
            self.activated = f"{line}\n"
        shown, aside = self.in_shell(self.activated + line, self.environment)
        return ("" if "pip install " in line and self.code == 0 else shown), aside

    def steps(self, markdown: str) -> Iterator[Step]:
        """Everything that a page tells to type, with an eye on the clocks."""
        began, used = time.perf_counter(), processors()
        for line, said, printed in self.play(markdown):
            yield Step(line, said, printed, time.perf_counter() - began, processors() - used)
            began, used = time.perf_counter(), processors()


def processors() -> float:
    """Seconds that ended programs have spent on all processors."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def literally(name: str, *, suite: bool) -> str:
    """The page with its install commands as commands whose output may be anything, after those of the first tutorial."""
    if name == README:
        return readme(suite=suite)
    first, page = ((TUTORIALS / f"{stem}.md").read_text(encoding="utf-8") for stem in (FIRST, name))
    before = "" if name == FIRST else "".join(f"```sh\n{lines}```\n" for lines in _SHELL.findall(first))
    return _SHELL.sub(lambda block: console(*((line, "") for line in block[1].splitlines())), before + page)


def readme(*, suite: bool) -> str:
    """The README's two commands as a console block; its tree is broken into lines there."""
    (shown,) = _PRINTS.findall((ROOT / "README.md").read_text(encoding="utf-8"))
    result = re.sub(r"\n {11,}", " ", re.sub("^    ", "", shown, flags=re.MULTILINE))
    return console(("make run", result), *([("make test", "")] if suite else []))


def console(*typed: tuple[str, str]) -> str:
    """A block of commands that print something, and anything around it."""
    return "".join(["```console\n", *(f"$ {line}\n…\n{said}" + "…\n" * bool(said) for line, said in typed), "```"])


def follow(name: str, *, suite: bool) -> bool:
    """Print how long a page takes, and where it is wrong."""
    with tempfile.TemporaryDirectory() as place:
        steps = list(Newcomer(Path(place) / "grammarbt").steps(literally(name, suite=suite)))
    wrong = [step for step in steps if not agrees(step.said, step.printed)]
    installing = seconds([step for step in steps if step.installs])
    print(f"{name:12} {seconds(steps)}  {installing}  {len(steps):8}  {len(steps) - len(wrong):9}", flush=True)
    for step in steps:
        if step.clock >= 1 or step in wrong:
            print(f"{'':12} {seconds([step])}  {step.line[:100]}")
    for step in wrong:
        print(f"\n{name} says\n\n$ {step.line}\n{step.said}\nbut what is printed is\n\n{step.printed}")
    return not wrong


def seconds(steps: list[Step]) -> str:
    """On the clock, and of the processors."""
    return f"{sum(step.clock for step in steps):6.1f} ({sum(step.processors for step in steps):6.1f})"


def main() -> int:
    """A row for each page, then its longer commands."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", choices=[*PAGES, []], metavar="PAGE", help=", ".join(PAGES))
    parser.add_argument("--suite", action="store_true", help="the README's `make test`, too: some ten minutes")
    options = parser.parse_args()
    print(f"{'page':12} {'in all':>15}  {'of it installing':>15}  commands  as on page")
    right = [follow(name, suite=options.suite) for name in options.pages or PAGES]
    return 0 if all(right) else 1


if __name__ == "__main__":
    sys.exit(main())
