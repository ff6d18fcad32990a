"""Strings and TOML values become checked parameters, or an error that names the key."""

from typing import Literal

import attrs
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.errors import ParameterError
from grammarbt.plugins.parameters import build, describe


@attrs.frozen
class Knobs:
    """One field of every type."""

    count: int = attrs.field(default=3, validator=attrs.validators.ge(1), metadata={"help": "how many"})
    scale: float = 1.4
    trim: bool = True
    title: str = "none yet"
    preset: Literal["default", "paper"] = "default"
    limit: int | None = None
    names: tuple[str, ...] = attrs.field(factory=tuple)


@attrs.frozen
class Needy:
    """A field without default."""

    path: str


KNOBS = st.builds(
    Knobs,
    count=st.integers(min_value=1),
    scale=st.floats(allow_nan=False),
    trim=st.booleans(),
    title=st.text(),
    preset=st.sampled_from(["default", "paper"]),
    limit=st.none() | st.integers(),
    names=st.just(()),
)


@given(KNOBS)
def test_values_and_their_texts_give_the_same_parameters(knobs):
    values = {name: value for name, value in attrs.asdict(knobs).items() if name != "names"}
    assert build(Knobs, values, "searcher") == knobs
    assert build(Knobs, {name: str(value) for name, value in values.items()}, "searcher") == knobs


@pytest.mark.parametrize(
    ("settings", "message", "hint"),
    [
        ({"cuont": "1"}, "unknown parameter searcher.cuont", "did you mean 'count'?"),
        ({"count": "many"}, "parameter searcher.count must be an integer, not 'many'", "how many"),
        ({"count": 1.5}, "parameter searcher.count must be an integer, not 1.5", "how many"),
        ({"count": True}, "parameter searcher.count must be an integer, not True", "how many"),
        (
            {"count": "0"},
            "searcher: 'count' must be >= 1: 0",
            "see 'grammarbt plugins NAME' for the searcher's parameters",
        ),
        ({"scale": "nan"}, "parameter searcher.scale must be a number, not 'nan'", None),
        ({"trim": "maybe"}, "parameter searcher.trim must be true or false, not 'maybe'", None),
        ({"title": 3}, "parameter searcher.title must be a text, not 3", None),
        (
            {"preset": "papre"},
            "parameter searcher.preset must be one of default, paper, not 'papre'",
            "did you mean 'paper'?",
        ),
        ({"limit": "low"}, "parameter searcher.limit must be an integer or none, not 'low'", None),
        ({"names": "a"}, "parameter searcher.names must be tuple[str, ...], not 'a'", None),
    ],
)
def test_wrong_setting_names_the_key_and_what_is_expected(settings, message, hint):
    with pytest.raises(ParameterError) as caught:
        build(Knobs, settings, "searcher")
    assert (caught.value.message, caught.value.hint) == (message, hint)


def test_missing_parameter_is_named():
    with pytest.raises(ParameterError, match=r"parameter domain\.path is missing"):
        build(Needy, {}, "domain")


def test_description_follows_the_fields():
    first, *_, last = describe(Knobs)
    assert (first.name, first.type, first.default, first.help) == ("count", "an integer", 3, "how many")
    assert (last.name, last.default) == ("names", ())
    assert [parameter.required for parameter in describe(Needy)] == [True]
