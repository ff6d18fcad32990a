"""What the README says is true of the project."""

import re
from pathlib import Path

import pytest

from grammarbt.grammar import Source, bind, load_grammar
from grammarbt_marine.vocabulary import VOCABULARY

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("folder", ["tutorials", "how-to", "explanation"])
def test_every_page_can_be_found_from_here(folder):
    pages = [str(path.relative_to(ROOT)) for path in sorted((ROOT / "docs" / folder).glob("*.md"))]
    assert pages
    assert [page for page in pages if f"]({page})" not in README] == []


def test_the_commands_are_targets_of_the_makefile():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in re.findall(r"^    make (\w+)", README, re.MULTILINE):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target


def test_the_grammar_in_the_readme_binds_to_the_marine_leaves():
    text = README.split("    %declare", 1)[1].split("\n\nTrees are", 1)[0]
    grammar = load_grammar(Source("README", "    %declare" + text))
    assert bind(grammar, VOCABULARY).start()


def test_named_searchers_domains_and_options_exist(cli):
    assert cli("plugins", "dagmcts").returncode == 0
    assert cli("plugins", "marine").returncode == 0
    for verb in re.findall(r"^    grammarbt (\w+)", README, re.MULTILINE):
        assert cli(verb, "--help").returncode == 0
