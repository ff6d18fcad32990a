"""A vocabulary, and grammars of many kinds over it."""

import pytest

from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars

VOCABULARY = Vocabulary(
    (
        Group("g1", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),
        Group("g2", (ActionType("e"),), (ConditionType("f"),)),
        Group("g3", (ActionType("h"), ActionType("i")), (ConditionType("j"),)),
    )
)
START = "%declare ACTION CONDITION\n"
OWN = {
    "lists": '%limit nodes 9\nstart: "?" "(" ACTION ACTION+ ")"\n',
    "unique": '%unique ACTION in start\nstart: "?" "(" ACTION* sure ")"\nsure: "→" "(" ACTION ")"\n',
    "pairs": 'start: "?" "(" pairs ")"\npairs: pairs CONDITION ACTION | ACTION\n',
    "nested": '%limit depth 5\nstart: ACTION | "→" "(" CONDITION start ")" | "?" "(" start start ")"\n',
    "counted": 'start: "?" "(" CONDITION~2..4 ACTION? ACTION ")"\n',
    "scopes": (
        "%unique ACTION in part\n%unique CONDITION in start\n%limit nodes 6 in part\n%limit nodes 20\n"
        'start: "?" "(" part* last CONDITION* ")"\n'
        'part: "→" "(" CONDITION* [part] ACTION+ ")"\nlast: "→" "(" part ACTION part* ")"\n'
    ),
}


@pytest.fixture(scope="session")
def grammars():
    """Every shipped grammar and some more, bound, by name."""
    sources = shipped_grammars() | {name: Source(f"{name}.grammar", START + text) for name, text in OWN.items()}
    return {name: bind(load_grammar(source), VOCABULARY) for name, source in sources.items()}


@pytest.fixture(scope="session")
def vocabulary():
    return VOCABULARY
