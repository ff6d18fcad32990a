"""Whatever JSON a program answers, an episode is shown or refused in a sentence."""

import json
from contextlib import closing

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from told_episodes import EPISODE, TREE, Teller, altered, line

from grammarbt.bt import parse
from grammarbt.errors import DomainError
from grammarbt.report import btlog
from grammarbt.report.replay import replay_page


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    with closing(Teller(tmp_path_factory.mktemp("told"))) as teller:
        yield teller


KEYS = st.sampled_from(["id", "frames", "marks", "answers", "reward", "changes", "events", "box", "name", "x", "size"])
SCALARS = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(), st.sampled_from(["success", "running", "circle"])
)
JSON = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS | st.text(), inner, max_size=4),
    max_leaves=12,
)
"""What a line of JSON may hold, and what Python reads beyond, as NaN."""


def places(value, way=()):
    """The way to each part of a JSON value."""
    steps = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in steps:
        yield (*way, key)
        yield from places(part, (*way, key))


ALTERED = st.builds(altered, st.sampled_from(list(places(EPISODE))), JSON)
NUMBERS = st.sampled_from([("box", 2), ("box", 1), ("marks", 0, "x"), ("marks", 1, "size"), ("frames", 1, "reward")])
NAMES = st.sampled_from(
    [("unit",), ("marks", 0, "name"), ("frames", 0, "changes", 0, "name"), ("frames", 1, "events", 0)]
)
LIKELY = st.builds(altered, NUMBERS, st.floats() | st.integers(-9, 9)) | st.builds(altered, NAMES, st.text())
"""Episodes with one wrong part, and with one that may be right."""


def shown(told, text):
    """The page of the episode that the text tells, or why there is none."""
    try:
        episode = told(text)
    except DomainError as error:
        return error.message
    assert btlog.dumps(parse(TREE), episode)
    return replay_page("told", parse(TREE), episode)


@settings(deadline=None, max_examples=50)
@given(JSON.map(json.dumps) | (ALTERED | LIKELY).map(line))
def test_whatever_json_a_program_writes_is_an_episode_that_can_be_shown_or_an_error(told, text):
    page_or_reason = shown(told, text)
    assert page_or_reason.endswith("</html>\n") or "did not answer the request: " in page_or_reason
