"""Hostile grammar files: random texts, mutations of the shipped grammars, and texts built to blow up.

Mutations of characters mostly end as syntax errors; edits of words, signs and whole statements mostly do not, and so
come to whatever works behind the reader.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

import numpy as np

from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.errors import GrammarError
from grammarbt.grammar import (
    GrammarFileError,
    NotInLanguageError,
    Source,
    bind,
    load_grammar,
    parse_tree,
    shipped_grammars,
)

PIECES = (
    "start", "start: ", "a", "b", "x", "g", "g1", "tree{g}", "ACTION", "CONDITION", "ACTION{g}", "GROUP", ":", "|",
    "(", ")", "[", "]", "{", "}", "?", "*", "+", "~", "~2", "~1..3", "~1..1000", "~0", "..", ",", "->", "->", "@", "0.5",
    "%declare ", "%forall g in GROUP", "%unique ", "%limit nodes ", "%limit depth 3", "%import ", ".common", "in",
    '"?" "("', '")"', '"→"', '"!"', '"‖2"', '"[a1]"', '"(', '"', "\\", "//", "\n", "\n", "\n", " ", "\t", "\r\n", "é",
    "\x00", "😀", "9" * 30,
)  # fmt: skip

VOCABULARY = Vocabulary(
    tuple(
        Group(
            f"g{number}",
            tuple(ActionType(f"a{number}{at}") for at in range(2)),
            tuple(ConditionType(f"c{number}{at}") for at in range(2)),
        )
        for number in range(1, 4)
    )
)


def random_text(rng: random.Random) -> str:
    """Pieces of the language in any order."""
    return "".join(rng.choice(PIECES) for _ in range(rng.randrange(60)))


def mutated(rng: random.Random) -> str:
    """A shipped grammar with chunks cut, doubled, swapped, or replaced by a piece of the language."""
    text = rng.choice([source.text for source in shipped_grammars().values()])
    for _ in range(rng.randrange(1, 4)):
        one, two = sorted(rng.randrange(len(text) + 1) for _ in range(2))
        two = min(two, one + rng.choice((1, 5, 40)))
        other = rng.randrange(len(text) + 1)
        text = rng.choice(
            (
                text[:one] + text[two:],
                text[:two] + text[one:two] * rng.choice((1, 2, 30)) + text[two:],
                text[:other] + text[one:two] + text[other:],
                text[:one] + rng.choice(PIECES) + text[two:],
            )
        )
    return text


_TOKEN = re.compile(r'"[^"\n]*"|//[^\n]*|%\w+|\w+|\s+|.')
_STRINGS = ('"?"', '"→"', '"!"', '"‖2"', '"("', '")"', '"[a11]"', '"(c11)"', '"?" "("', '"!" "("')
_POSTFIX = ("?", "*", "+", "~2", "~1..3", "~0..2", "~5..40", "{g}", "{ACTION}", " @ 3", " | ACTION", " | start")
_STATEMENTS = (
    "%limit nodes {n}", "%limit depth {n}", "%limit nodes {n} in {a}", "%limit depth {n} in {a}", "%unique ACTION in {a}",
    "%unique ACTION CONDITION in {a}", "%unique g in {a}", "%forall h in GROUP", "%import general.{a}",
    "{a}: {b} | ACTION", '{a}: "→" "(" {b}+ ")"', "extra{{x}}: {a} x | x", '{a}: "?" "(" {a} {b} ")" | CONDITION',
)  # fmt: skip


def edited(rng: random.Random) -> str:
    """A shipped grammar in which names, strings, repetitions and statements have been changed or exchanged."""
    text = rng.choice([source.text for source in shipped_grammars().values()])
    for _ in range(rng.randrange(1, 5)):
        words = _TOKEN.findall(text)
        places = list(_in_rules(words))
        names = [at for at in places if words[at][0].isalpha()]
        strings = [at for at in places if words[at][0] == '"']
        if names and strings:
            text = rng.choice((_renamed, _respelt, _repeated, _rearranged))(rng, words, names, strings)
    return text


def _in_rules(words: list[str]) -> Iterator[int]:
    """Places on the right-hand sides of rules, outside braces."""
    right, level = False, 0
    for at, word in enumerate(words):
        if "\n" in word:
            right = word.endswith(" ")
        level += (word == "{") - (word == "}")
        if right and not level:
            yield at
        right = (right or word == ":") and not word.startswith("%")


def _renamed(rng: random.Random, words: list[str], names: list[int], strings: list[int]) -> str:
    """A name stands where another one stood."""
    del strings
    words[rng.choice(names)] = rng.choice((words[rng.choice(names)], "ACTION", "CONDITION", "g1"))
    return "".join(words)


def _respelt(rng: random.Random, words: list[str], names: list[int], strings: list[int]) -> str:
    """Another string, a string for a name, or nothing."""
    words[rng.choice((*strings, *names))] = rng.choice((*_STRINGS, ""))
    return "".join(words)


def _repeated(rng: random.Random, words: list[str], names: list[int], strings: list[int]) -> str:
    """Something is repeated, optional, or has another alternative; or a number changes."""
    numbers = [at for at, word in enumerate(words) if word.isdigit()]
    if numbers and rng.random() < 1 / 4:
        words[rng.choice(numbers)] = str(rng.choice((0, 1, 2, 3, 7, 50, 400)))
    else:
        words[rng.choice((*names, *strings))] += rng.choice(_POSTFIX)
    return "".join(words)


def _rearranged(rng: random.Random, words: list[str], names: list[int], strings: list[int]) -> str:
    """A line is lost, doubled or moved, or a statement is added."""
    del strings
    lines = "".join(words).split("\n")
    line = rng.randrange(len(lines))
    new = rng.choice(_STATEMENTS).format(
        n=rng.choice((0, 1, 3, 12, 60, 900)), a=words[rng.choice(names)], b=words[rng.choice(names)]
    )
    cut = lines[:line] + lines[line + 1 :]
    other = rng.randrange(len(lines))
    return "\n".join(
        rng.choice(
            (cut, [*cut[:other], lines[line], *cut[other:]], [*lines, lines[line]], [*lines, new], [*lines, new])
        )
    )


def explosive() -> Iterator[tuple[str, str]]:
    """Named texts that a careless reader would not survive."""
    leaf = "%declare ACTION CONDITION\n"
    yield "deep parentheses", f"{leaf}start: {'(' * 5000}ACTION{')' * 5000}"
    yield "deep brackets", f"{leaf}start: {'[' * 39}ACTION{']' * 39}"
    yield "deep templates", f"{leaf}start: {'t{' * 5000}ACTION{'}' * 5000}\nt{{x}}: x"
    yield "repetition of repetition", f'{leaf}start: "?" "(" (ACTION~1..1000)~1..1000 ")"'
    yield "thrice repeated", f'{leaf}start: "?" "(" ((ACTION~1..1000)~1..1000)~1..1000 ")"'
    yield "long repetition", f'{leaf}start: "?" "(" ACTION~1000..1000 ")"'
    yield "unique in a long repetition", f'{leaf}%unique ACTION in start\nstart: "?" "(" ACTION~1..1000 ")"'
    yield "operators in a row", f"{leaf}start: ACTION{'?' * 5000}"
    yield "one deep tree", f'{leaf}start: {chr(34)}!{chr(34)} "(" start ")" | ACTION'
    yield "very deep string", f'{leaf}start: "{"!(" * 2000}[a11]{")" * 2000}"'
    yield "growing template", f'{leaf}start: t{{ACTION}}\nt{{x}}: "?" "(" t{{u{{x}}}} x ")" | x\nu{{x}}: x x'
    doubling = "\n".join(f"t{at}{{x}}: t{at + 1}{{u{{x}}}} t{at + 1}{{x}}" for at in range(40))
    yield "exponential templates", f'{leaf}start: "?" "(" t0{{ACTION}} ")"\n{doubling}\nt40{{x}}: x\nu{{x}}: x | x x'
    pasting = "\n".join(f"t{at}{{x}}: t{at + 1}{{v{at}{{x}}}}\nv{at}{{x}}: x x" for at in range(300))
    yield "long chain of templates", f'{leaf}start: "?" "(" t0{{ACTION}} ")"\n{pasting}\nt300{{x}}: x'
    variables = ", ".join(f"v{at}" for at in range(12))
    sets = " ".join(f"ACTION{{v{at}}}" for at in range(12))
    yield "many variables", f'{leaf}%forall {variables} in GROUP\nstart: "?" "(" {sets} ")"'
    each = " ".join("each" for _ in range(30))
    forall = "%forall g in GROUP\n%unique g in start\neach: ACTION{g}\n"
    yield "more sub-trees than groups", f'{leaf}{forall}start: "?" "(" {each} ")"'
    yield "nested scopes", f'{leaf}%unique ACTION CONDITION in t\nstart: t\nt: "?" "(" (t | ACTION | CONDITION)+ ")"'
    pairs = " ".join("(ACTION | CONDITION)" for _ in range(25))
    yield "entangled", f'{leaf}%unique ACTION CONDITION in start\nstart: "?" "(" {pairs} ")"'
    parts = "\n".join(f'r{at}: "[a11]" | "[a10]" | "[a21]" | "[a20]" | "(c11)"' for at in range(30))
    row = " ".join(f"r{at}" for at in range(30))
    yield "pigeons", f'{leaf}%unique ACTION CONDITION in start\nstart: "?" "(" {row} ")"\n{parts}'
    chain = "\n".join(f"r{at}: r{at + 1} | r{at + 2}" for at in range(3000))
    yield "chain of rules", f"{leaf}start: r0\n{chain}\nr3000: ACTION\nr3001: ACTION"
    ring = "\n".join(f"r{at}: r{(at + 1) % 3000} ACTION | ACTION" for at in range(3000))
    yield "ring of rules", f'{leaf}start: "?" "(" r0 ")"\n{ring}'
    wide = " | ".join('"[a11]"' for _ in range(20000))
    yield "wide rule", f"{leaf}start: {wide}"
    yield "huge file", "// " + "x" * 2_000_000
    yield "large file", f"{leaf}start: ACTION\n" + "\n".join(f"r{at}: r{at} x y z" for at in range(5000))
    yield "deep limit", f'{leaf}%limit depth 999999\n%limit nodes 999999\nstart: "?" "(" (start | ACTION)+ ")"'
    yield "many limits", leaf + "%limit depth 900\n" * 300 + 'start: "?" "(" (start | ACTION)+ ")"'
    yield "many directives", leaf * 5000 + "start: ACTION"
    yield "depth of everything", f'{leaf}%limit depth 400\nstart: "?" "(" (start | ACTION)~1..60 ")"'


def outcome(text: str, vocabulary: Vocabulary = VOCABULARY) -> tuple[str, bool]:
    """`bound`, or the code of the first finding, and whether the binder was reached; all else that happens is a bug.

    What is bound has to derive a tree, unless its random trees grow without end, and to read that tree back.
    """
    read = False
    try:
        grammar = load_grammar(Source("hostile.grammar", text))
        read = True
        bound = bind(grammar, vocabulary)
    except GrammarFileError as error:
        error.render()
        return error.diagnostics[0].code, read
    try:
        tree = bound.tree(bound.derive(bound.sample(np.random.default_rng(0))))
        parse_tree(bound, tree)
    except GrammarFileError as error:
        return error.diagnostics[0].code, True
    except NotInLanguageError:
        raise
    except GrammarError:
        return "bound, but endless", True
    return "bound", True
