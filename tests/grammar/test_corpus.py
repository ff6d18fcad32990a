"""Every shipped grammar takes the words of its corpus, and no other."""

from pathlib import Path

import numpy as np
import pytest
from attrs import frozen

from grammarbt.bt import format_tree, parse
from grammarbt.bt.model import Action
from grammarbt.bt.notation import tokens
from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import NotInLanguageError, bind, load_grammar, parse_tree, shipped_grammars

NAMES = sorted(shipped_grammars())
CORPUS = Path(__file__).parents[2] / "grammars" / "corpus"


@frozen
class Corpus:
    vocabulary: Vocabulary
    words: tuple[str, ...]
    others: tuple[str, ...]


def read_corpus(name: str) -> Corpus:
    groups, words, others = [], [], []
    for line in (CORPUS / f"{name}.txt").read_text(encoding="utf-8").splitlines():
        kind, _, rest = line.partition("#")[0].strip().partition(" ")
        if kind == "group":
            title, _, leaves = rest.partition(":")
            groups.append(_group(title, leaves))
        elif kind == "in":
            words.append(rest.strip())
        elif kind == "out":
            others.append(rest.strip())
        else:
            assert not kind, f"{name}.txt: {line!r}"
    return Corpus(Vocabulary(tuple(groups)), tuple(words), tuple(others))


def _group(name, leaves):
    found = tokens(leaves)
    return Group(
        name,
        tuple(ActionType(leaf.name) for leaf in found if isinstance(leaf, Action)),
        tuple(ConditionType(leaf.name) for leaf in found if not isinstance(leaf, Action)),
    )


@pytest.fixture(params=NAMES)
def corpus_of(request):
    corpus = read_corpus(request.param)
    return corpus, bind(load_grammar(shipped_grammars()[request.param]), corpus.vocabulary)


def belongs(grammar, text):
    """Whether the reader of trees finds a derivation, and it spells the same tree."""
    tree = parse(text)
    try:
        derivation = parse_tree(grammar, tree)
    except NotInLanguageError:
        return False
    assert grammar.tree(grammar.derive(derivation)) == tree
    return True


def test_every_shipped_grammar_has_a_corpus():
    assert sorted(path.stem for path in CORPUS.glob("*.txt")) == NAMES


def test_words_of_the_corpus_belong(corpus_of):
    corpus, grammar = corpus_of
    assert corpus.words
    assert [word for word in corpus.words if not belongs(grammar, word)] == []


def test_other_trees_of_the_corpus_do_not_belong(corpus_of):
    corpus, grammar = corpus_of
    assert corpus.others
    assert [word for word in corpus.others if belongs(grammar, word)] == []


def test_sampled_words_belong(corpus_of):
    _, grammar = corpus_of
    rng = np.random.default_rng(0)
    words = [format_tree(grammar.tree(grammar.derive(grammar.sample(rng)))) for _ in range(50)]
    assert len(set(words)) > 10
    assert [word for word in words if not belongs(grammar, word)] == []


@pytest.mark.parametrize("name", NAMES)
def test_a_shipped_grammar_says_in_its_first_line_what_it_is(name):
    assert shipped_grammars()[name].text.startswith("// ")
