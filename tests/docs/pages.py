"""Types what stands on a page of the documentation, and compares what it prints.

    python tests/docs/pages.py docs/tutorials/grammar.md      # brings what commands print up to date

A block that begins with ```python robot.py is the file robot.py, and ```python robot.py (at the end) goes to its end. In a
`console` block each line that begins with `$` is a command, with what it prints below. There `…` stands for anything: a
line of its own for any number of lines, inside a line for any text. Warnings and progress are not shown on pages; the
message of a mistake is. A page that takes something for granted, a run say, has the command for it in a comment of a line,
`<!-- $ … -->`; these are typed first.
"""

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import cast

from attrs import define, frozen
from installing import install

from grammarbt.cli import main

ROOT = Path(__file__).parents[2]
PROGRAMS = ("grammarbt", "python", "ls", "cat")
"""What pages may type besides pip, which is never called: it would change the environment that the tests run in."""

ANSWERS_NO = 1

_FENCE = re.compile(r"^(?P<fence>```+)(?P<language>\w*) ?(?P<name>.*)\n(?P<text>(?:.*\n)*?)(?P=fence)$", re.MULTILINE)
_AT_THE_END = " (at the end)"
_COMMAND = re.compile(r"^\$ (?P<line>.*(?:\\\n> .*)*)\n(?P<said>(?:(?!\$ ).*\n)*)", re.MULTILINE)
_GRANTED = re.compile(r"^<!-- \$ (.*) -->$", re.MULTILINE)
_DURATION = re.compile(r"\b\d[\d.,]* s$", re.MULTILINE)


@frozen
class Block:
    """A code block: its language, the file that it is if any, and its text."""

    language: str
    name: str
    text: str


def blocks(markdown: str) -> Iterator[Block]:
    """Every code block, in order."""
    for found in _FENCE.finditer(markdown):
        yield Block(found["language"], found["name"], found["text"])


def commands(block: Block) -> Iterator[tuple[str, str]]:
    """Each command of a console block, and what the page says it prints."""
    for found in _COMMAND.finditer(block.text):
        yield found["line"].replace("\\\n> ", ""), found["said"]


@define
class Terminal:
    """Somebody who types in a folder like the project's.

    Attributes:
        folder: where.
        code: the last command's exit code.
        site: where what they install goes, once they have.
    """

    folder: Path
    code: int = 0
    site: Path | None = None

    def __attrs_post_init__(self) -> None:
        """The folder has what commands on pages name."""
        for name in ("docs", "grammars"):
            (self.folder / name).symlink_to(ROOT / name)

    def play(self, markdown: str) -> Iterator[tuple[str, str, str]]:
        """Write the files of a page and run its commands, in order; yields command, what the page says, what it printed."""
        for line in _GRANTED.findall(markdown):
            self.type(line)
        for block in blocks(markdown):
            if block.name:
                self._write(block)
            elif block.language == "console":
                for line, said in commands(block):
                    yield line, said, self.type(line)

    def type(self, line: str) -> str:
        """What a command prints."""
        if line == "echo $?":
            return f"{self.code}\n"
        shown, aside = self.run(line)
        went_well = self.code == 0 or (line.startswith("grammarbt ") and self.code == ANSWERS_NO)
        return shown if went_well else shown + aside

    def run(self, line: str) -> tuple[str, str]:
        """What a command writes to standard output and to standard error; its exit code is kept."""
        if line.startswith("pip install "):
            return self._install(line), ""
        program = line.partition(" ")[0]
        if program not in PROGRAMS:
            raise ValueError(f"pages type {PROGRAMS} only, not {program!r}")
        return self._own(line) if program == "grammarbt" and self.site is None else self._other(line)

    def _write(self, block: Block) -> None:
        path = self.folder / block.name.removesuffix(_AT_THE_END)
        with path.open("a" if block.name.endswith(_AT_THE_END) else "w", encoding="utf-8") as file:
            file.write(block.text)

    def _install(self, line: str) -> str:
        self.site = self.folder / "site"
        given = shlex.split(line)[-1].partition("[")[0]
        install(self.folder / given, self.site)
        return ""

    def _own(self, line: str) -> tuple[str, str]:
        """In this process, as that spares importing everything anew."""
        shown, aside = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(shown), contextlib.redirect_stderr(aside):
            self.code = main([name for word in shlex.split(line)[1:] for name in _expanded(word)])
        return _written(shown), _written(aside)

    def _other(self, line: str) -> tuple[str, str]:
        path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
        return self.in_shell(line, os.environ | {"PATH": path, "PYTHONPATH": str(self.site or "")})

    def in_shell(self, line: str, environment: Mapping[str, str]) -> tuple[str, str]:
        """As `run`, in a process of its own."""
        done = subprocess.run(
            ["bash", "-c", line],  # noqa: S607 - the reader's own
            cwd=self.folder,
            env=environment,
            check=False,
            capture_output=True,
            text=True,
        )
        self.code = done.returncode
        return done.stdout, done.stderr


def _expanded(word: str) -> list[str]:
    """As a shell does it; only `*`, for trees in notation hold the other signs."""
    return sorted(map(str, Path().glob(word))) if "*" in word else [word]


def _written(stream: io.TextIOWrapper) -> str:
    return cast("io.BytesIO", stream.buffer).getvalue().decode()


def agrees(said: str, printed: str) -> bool:
    """Whether a page says what was printed."""
    pattern = re.escape(said)
    pattern = re.sub(r"^…\n", r"(?:.*\\n)*?", pattern.replace("\\\n", "\n"), flags=re.MULTILINE)
    return re.fullmatch(pattern.replace("…", ".*"), printed) is not None


def updated(markdown: str, terminal: Terminal) -> str:
    """The page with what its commands print now, durations left open; what still agrees stays as it is."""
    for line, said, printed in list(terminal.play(markdown)):
        if not agrees(said, printed):
            typed = line.replace("\\", "\\\\")
            fresh = _DURATION.sub("… s", printed)
            markdown = markdown.replace(f"$ {typed}\n{said}", f"$ {typed}\n{fresh}", 1)
    return markdown


if __name__ == "__main__":
    for given in sys.argv[1:]:
        page = Path(given).absolute()
        with tempfile.TemporaryDirectory() as place:
            page.write_text(updated(page.read_text(encoding="utf-8"), Terminal(Path(place))), encoding="utf-8")
