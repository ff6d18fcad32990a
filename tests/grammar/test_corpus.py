"""Every shipped grammar takes the words of its corpus, and no other."""

from pathlib import Path

import numpy as np
import pytest
from attrs import frozen

from grammarbt.bt import format_tree, parse
from grammarbt.bt.model import Action, Condition
from grammarbt.bt.notation import BracketToken, OperatorToken, operator, tokens
from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import bind, load_grammar, shipped_grammars

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


def spelt(tree):
    """The tokens of a tree as grammars write them, with parentheses around every operator's children."""
    if isinstance(tree, Action | Condition):
        return [tree]
    children = getattr(tree, "children", None) or (tree.child,)
    inside = [token for child in children for token in spelt(child)]
    return [OperatorToken(operator(tree)), BracketToken("("), *inside, BracketToken(")")]


def belongs(grammar, text):
    """Walk all leftmost derivations that agree with the word."""
    number = {token: at for at, token in enumerate(grammar.terminals)}
    word = tuple(number.get(token, -1) for token in spelt(parse(text)))
    seen, queue = set(), [(0, grammar.start())]
    while queue:
        at, state = queue.pop()
        if (at, state) in seen:
            continue
        seen.add((at, state))
        if not state.symbols and at == len(word):
            return True
        for move in grammar.leftmost.moves(state):
            end = at + len(move.emits)
            if word[at:end] == move.emits:
                queue.append((end, move.after))
    return False


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
