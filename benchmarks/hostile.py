"""Hostile grammar files: random texts, mutations of the shipped grammars, and texts built to blow up."""

from __future__ import annotations

import random
from collections.abc import Iterator

from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import GrammarFileError, Source, bind, load_grammar, shipped_grammars

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


def outcome(text: str, vocabulary: Vocabulary = VOCABULARY) -> str:
    """`bound`, or the code of the first finding; anything else that happens is a bug."""
    try:
        bind(load_grammar(Source("hostile.grammar", text)), vocabulary)
    except GrammarFileError as error:
        error.render()
        return error.diagnostics[0].code
    return "bound"
