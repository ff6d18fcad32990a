"""Types what stands on a page of the documentation, and compares what it prints.

    python tests/docs/pages.py docs/tutorials/grammar.md      # brings what commands print up to date

On a page, a `{code-block}` with a `:caption:` is a file of that name, and in a `console` block each line that begins with
`$` is a command, with what it prints below. There `…` stands for anything: a line of its own for any number of lines,
inside a line for any text. Warnings and progress are not shown on pages; the message of a mistake is.
"""

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from attrs import define, frozen

from grammarbt.cli import main

ROOT = Path(__file__).parents[2]
ANSWERS = (0, 1)  # exit codes of commands that went well: 1 where a verb answers no

_FENCE = re.compile(
    r"^(?P<fence>```+)(?P<head>[^`\n]*)\n(?::caption: (?P<name>\S+)\n\n)?(?P<text>.*?)^(?P=fence)$", re.M | re.S
)
_COMMAND = re.compile(r"^\$ (?P<line>.*(?:\\\n> .*)*)\n(?P<said>(?:(?!\$ ).*\n)*)", re.M)
_DURATION = re.compile(r"\b\d[\d.,]* s$", re.M)


@frozen
class Block:
    """A code block: its language, the file that it is if any, and its text."""

    language: str
    name: str | None
    text: str


def blocks(markdown: str) -> Iterator[Block]:
    """Every code block, in order."""
    for found in _FENCE.finditer(markdown):
        language = found["head"].replace("{code-block}", "").strip()
        yield Block(language, found["name"], found["text"])


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
    """

    folder: Path
    code: int = 0

    def __attrs_post_init__(self) -> None:
        """The folder has what commands on pages name."""
        for name in ("docs", "grammars"):
            (self.folder / name).symlink_to(ROOT / name)

    def play(self, markdown: str) -> Iterator[tuple[str, str, str]]:
        """Write the files of a page and run its commands, in order; yields command, what the page says, what it printed."""
        for block in blocks(markdown):
            if block.name is not None:
                (self.folder / block.name).write_text(block.text, encoding="utf-8")
            elif block.language == "console":
                for line, said in commands(block):
                    yield line, said, self.type(line)

    def type(self, line: str) -> str:
        """What a command prints."""
        if line == "echo $?":
            return f"{self.code}\n"
        shown, aside = self._own(line) if line.startswith("grammarbt ") else self._other(line)
        return shown if self.code in ANSWERS else shown + aside

    def _own(self, line: str) -> tuple[str, str]:
        """In this process, as that spares importing everything anew."""
        shown, aside = io.StringIO(), io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(shown), contextlib.redirect_stderr(aside):
            self.code = main(shlex.split(line)[1:])
        return shown.getvalue(), aside.getvalue()

    def _other(self, line: str) -> tuple[str, str]:
        path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
        done = subprocess.run(
            ["bash", "-c", line],  # noqa: S607 - the reader's own
            cwd=self.folder,
            env=os.environ | {"PATH": path},
            check=False,
            capture_output=True,
            text=True,
        )
        self.code = done.returncode
        return done.stdout, done.stderr


def agrees(said: str, printed: str) -> bool:
    """Whether a page says what was printed."""
    pattern = re.escape(said)
    pattern = re.sub(r"^…\n", r"(?:.*\\n)*?", pattern.replace("\\\n", "\n"), flags=re.M)
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
