"""The tutorials on writing components: every file is written, every command is called, in the order of the page, and prints what it says."""

import os
import re
import runpy
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "docs" / "tutorials" / f"{name}.md" for name in ("simulator", "searcher")]
BLOCK = re.compile(r"^```(\w+) ?(.*?)\n(.*?)^```", re.DOTALL | re.MULTILINE)
AT_THE_END = " (at the end)"
INSTALL = runpy.run_path(str(ROOT / "tests" / "cli" / "test_new.py"))["install"]


class Reader:
    """Someone who does what a tutorial says, in an empty folder."""

    def __init__(self, folder):
        self.folder, self.site = folder / "work", folder / "site"
        self.folder.mkdir()

    def do(self, language, name, text):
        if language == "console":
            for command, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
                printed = self.call(*shlex.split(command))
                missing = [line for line in expected.splitlines() if line not in printed]
                assert not missing, f"{command} printed\n{printed}"
        elif name.endswith(AT_THE_END):
            path = self.folder / name.removesuffix(AT_THE_END)
            path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")
        else:
            (self.folder / name).write_text(text, encoding="utf-8")

    def call(self, program, *arguments):
        if program == "pip":
            return INSTALL(self.folder / arguments[-1].partition("[")[0], self.site)
        words = {"grammarbt": ["-m", "grammarbt"], "python": []}[program]
        done = subprocess.run(
            [sys.executable, *words, *arguments],
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": str(self.site)},
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        assert done.returncode == 0, f"{program} {' '.join(arguments)}: {done.stdout}{done.stderr}"
        return done.stdout.splitlines()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_tutorial_says_can_be_done_and_comes_out_so(page, tmp_path):
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    assert {language for language, _, _ in blocks} >= {"python", "console"}
    reader = Reader(tmp_path)
    for block in blocks:
        reader.do(*block)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_link_of_a_tutorial_leads_to_a_file(page):
    links = re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8"))
    assert links
    assert not [link for link in links if not (page.parent / link).exists()]
