"""Valid trees per second, beside other grammar libraries: `python benchmarks/grammar_speed.py [WORDS] [RIVAL_WORDS]`.

All draw from the same productions, those of Table I over the groups of the marine robot. The others cannot state that a
leaf or a group comes only once, so only their valid words count. They are optional: `pip install alogos geneticengine`.
What is valid is told by brute force: each sub-tree must be among the listed words of its group.

Prints a table, by the process's own clock, on one core; exits with 1 if one of our words is not valid.
"""

from __future__ import annotations

import random
import sys
from abc import ABC
from collections.abc import Callable, Iterator, Sequence
from dataclasses import make_dataclass
from time import process_time
from typing import Any

import numpy as np
from attrs import frozen

from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import BoundGrammar, Language, Uniform, Word, bind, load_grammar, shipped_grammars

SIZES = ((2, 3), (1, 2), (2, 2), (1, 1), (1, 0), (1, 0))
BATCH = 10_000
SEED = 0
DEPTH = 20
"""Levels up to which geneticengine builds derivations."""

Draw = Callable[[int], Sequence[Word]]


@frozen
class Result:
    """What one contender did."""

    name: str
    words: int
    valid: int
    seconds: float
    seconds_of_text: float = 0.0

    def row(self) -> str:
        """A line of the table."""
        rate, valid = self.words / self.seconds, self.valid / self.seconds
        text = f"{self.words / (self.seconds + self.seconds_of_text):11,.0f}"
        return f"{self.name:34}{self.words:11,}{rate:11,.0f}{text}{valid:11,.0f}{self.words - self.valid:11,}"


def main(words: int = 1_000_000, rival_words: int = 5_000) -> int:
    """Run every contender on the same grammar."""
    grammar = table_one()
    is_valid = Validity(grammar)
    ours = [measured(name, draw, words, grammar, is_valid) for name, draw in our_draws(grammar)]
    rivals = [measured(name, draw, rival_words, grammar, is_valid) for name, draw in rival_draws(grammar)]
    print(f"{'':34}{'words':>11}{'words/s':>11}{'with text':>11}{'valid/s':>11}{'invalid':>11}")
    for result in [*ours, *rivals]:
        print(result.row())
    if rivals:
        best = max(result.words / result.seconds for result in rivals)
        slowest = min(result.valid / result.seconds for result in ours)
        print(f"valid words of the slowest of ours per word, valid or not, of the fastest other: {slowest / best:,.0f}")
    return int(any(result.valid < result.words for result in ours))


def table_one() -> BoundGrammar:
    """Table I over groups of the marine robot's sizes."""
    groups = tuple(
        Group(
            f"g{at}",
            tuple(ActionType(f"action {at}.{number}") for number in range(actions)),
            tuple(ConditionType(f"condition {at}.{number}") for number in range(conditions)),
        )
        for at, (actions, conditions) in enumerate(SIZES, 1)
    )
    return bind(load_grammar(shipped_grammars()["scheide"]), Vocabulary(groups))


class Validity:
    """Whether a row of terminals is a tree of at least two groups' sub-trees, each group once; by listing sub-trees."""

    def __init__(self, grammar: BoundGrammar) -> None:
        self.block_of = {word: block for block in grammar.blocks for _, word in grammar.enumerate(block)}
        self.opening, self.closing = grammar.brackets
        self.root = grammar.token_texts.index("?")

    def __call__(self, word: Word) -> bool:
        """Cut the word between its outermost parentheses and look each piece up."""
        if word[:2] != (self.root, self.opening):
            return False
        blocks = [self.block_of.get(piece) for piece in self._pieces(word[2:-1])]
        return len(blocks) > 1 and None not in blocks and len(set(blocks)) == len(blocks)

    def _pieces(self, row: Word) -> Iterator[Word]:
        level = start = 0
        for at, symbol in enumerate(row):
            if symbol == self.opening:
                level += 1
            elif symbol == self.closing:
                level -= 1
                if level == 0:
                    yield row[start : at + 1]
                    start = at + 1


def our_draws(grammar: BoundGrammar) -> Iterator[tuple[str, Draw]]:
    """The ways of drawing words that this project has."""
    rng, language = np.random.default_rng(SEED), Language(grammar)
    uniform = Uniform(language)
    yield "grammarbt, uniform over words", lambda number: uniform.draw(rng, number)
    walk, start = grammar.leftmost.random_walk, grammar.start()
    yield "grammarbt, random derivations", lambda number: [walk(start, rng)[1] for _ in range(number)]


def measured(name: str, draw: Draw, words: int, grammar: BoundGrammar, is_valid: Validity) -> Result:
    """Draw in batches; the clock runs for drawing, and apart for writing the words as text, not for checking them."""
    valid, seconds, seconds_of_text = 0, 0.0, 0.0
    texts = grammar.token_texts
    for done in range(0, words, BATCH):
        began = process_time()
        batch = draw(min(BATCH, words - done))
        drawn = process_time()
        for word in batch:
            " ".join([texts[symbol] for symbol in word])
        seconds += drawn - began
        seconds_of_text += process_time() - drawn
        valid += sum(map(is_valid, batch))
    return Result(name, words, valid, seconds, seconds_of_text)


def rival_draws(grammar: BoundGrammar) -> Iterator[tuple[str, Draw]]:
    """The other libraries, as far as they are installed."""
    for name, make in (("alogos", alogos_draw), ("geneticengine", geneticengine_draw)):
        try:
            yield f"{name}, random derivations", make(grammar)
        except ImportError:
            print(f"{name} is not installed", file=sys.stderr)


def alogos_draw(grammar: BoundGrammar) -> Draw:
    """The productions in Backus–Naur form, a number for each symbol."""
    from alogos import Grammar  # noqa: PLC0415 - optional

    rules = (
        f"<{lhs}> ::= " + " | ".join(" ".join(_bnf(grammar, symbol) for symbol in p.rhs) for p in own)
        for lhs, own in grammar.by_lhs.items()
    )
    rival = Grammar(bnf_text="\n".join(rules))
    random.seed(SEED)

    def draw(number: int) -> list[Word]:
        return [tuple(map(int, rival.generate_string(separator=" ").split())) for _ in range(number)]

    return draw


def _bnf(grammar: BoundGrammar, symbol: int) -> str:
    return f"<{symbol}>" if grammar.is_nonterminal(symbol) else str(symbol)


def geneticengine_draw(grammar: BoundGrammar) -> Draw:
    """A class for each nonterminal, a subclass for each production with a field for each nonterminal on its right."""
    from geneticengine.grammar.grammar import extract_grammar  # noqa: PLC0415 - optional
    from geneticengine.random.sources import NativeRandomSource  # noqa: PLC0415
    from geneticengine.representations.tree.initializations import MaxDepthDecider  # noqa: PLC0415
    from geneticengine.representations.tree.treebased import random_tree  # noqa: PLC0415

    kinds: dict[int, type] = {lhs: type(f"N{lhs}", (ABC,), {}) for lhs in grammar.by_lhs}
    classes: list[type] = []
    for production in grammar.productions:
        fields = [(f"x{at}", kinds[symbol]) for at, symbol in enumerate(production.rhs) if symbol in kinds]
        bases = (kinds[production.lhs],)
        classes.append(make_dataclass(f"P{production.number}", fields, bases=bases, namespace={"rhs": production.rhs}))
    rival = extract_grammar(classes, kinds[grammar.start_symbol])
    source = NativeRandomSource(SEED)
    decider = MaxDepthDecider(source, rival, DEPTH)
    return lambda number: [_spelled(random_tree(source, rival, decider)) for _ in range(number)]


def _spelled(tree: Any) -> Word:  # noqa: ANN401 - a class made at run time
    word: list[int] = []
    stack: list[Any] = [tree]
    while stack:
        node = stack.pop()
        if isinstance(node, int):
            word.append(node)
        else:
            stack += [getattr(node, f"x{at}", symbol) for at, symbol in reversed(list(enumerate(node.rhs)))]
    return tuple(word)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
