"""Vocabularies and grammars that the tests of the grammar language share."""

from pathlib import Path

import pytest

from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import bind, read_grammar

GRAMMARS = Path(__file__).parents[2] / "grammars"


def make_vocabulary(*sizes: tuple[int, int]) -> Vocabulary:
    """Groups g1, g2, … with so many actions and conditions each."""
    return Vocabulary(
        tuple(
            Group(
                f"g{number}",
                tuple(ActionType(f"a{number}.{at}") for at in range(actions)),
                tuple(ConditionType(f"c{number}.{at}") for at in range(conditions)),
            )
            for number, (actions, conditions) in enumerate(sizes, 1)
        )
    )


MARINE_SIZES = ((2, 3), (1, 2), (2, 2), (1, 1), (1, 0), (1, 0))


@pytest.fixture
def vocabulary():
    return make_vocabulary


@pytest.fixture
def bound():
    """Binds a shipped grammar to groups of the given sizes."""
    return lambda name, *sizes: bind(read_grammar(GRAMMARS / f"{name}.grammar"), make_vocabulary(*sizes))


@pytest.fixture
def marine_sizes():
    return MARINE_SIZES
