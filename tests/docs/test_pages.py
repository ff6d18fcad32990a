"""The pages: what they tell to type is typed, and prints what they say."""

import tomllib

import pytest
from pages import ROOT, Block, Terminal, agrees, blocks

from grammarbt.cli.app import VERBS

PAGES = sorted(path for path in (ROOT / "docs").rglob("*.md") if "_build" not in path.parts)
TYPED = [path for path in PAGES if "```console" in path.read_text(encoding="utf-8")]


def name_of(path):
    return str(path.relative_to(ROOT / "docs"))


@pytest.mark.parametrize("page", TYPED, ids=name_of)
def test_every_command_prints_what_the_page_says(page, tmp_path):
    played = list(Terminal(tmp_path).play(page.read_text(encoding="utf-8")))
    assert played
    for line, said, printed in played:
        if not agrees(said, printed):
            remedy = f"see whether that is right, then run: python tests/docs/pages.py docs/{name_of(page)}"
            assert f"$ {line}\n{printed}" == f"$ {line}\n{said}", remedy


def test_tutorials_are_typed():
    tutorials = {path for path in PAGES if path.parent.name == "tutorials"}
    assert tutorials <= set(TYPED)


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_toml_on_pages_is_toml(page):
    for block in blocks(page.read_text(encoding="utf-8")):
        if block.language == "toml":
            assert tomllib.loads(block.text)


def test_dots_stand_for_anything_and_nothing_else_does():
    assert agrees("a … c\n…\nend\n", "a b c\n1\n2\nend\n")
    assert agrees("a\n…\nend\n", "a\nend\n")
    assert not agrees("a … c\nend\n", "a b\nend\n")
    assert not agrees("a.c\n", "abc\n")


def test_a_block_may_be_a_file():
    assert list(blocks("```toml a.toml\nb = 1\n```\n")) == [Block("toml", "a.toml", "b = 1\n")]
    assert list(blocks("```text\n```\n")) == [Block("text", "", "")]


def test_every_verb_is_shown_somewhere():
    shown = "".join(path.read_text(encoding="utf-8") for path in PAGES if path.parent.name != "reference")
    assert [verb for verb in VERBS if f"grammarbt {verb}" not in shown] == []
