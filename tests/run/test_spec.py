"""Specs go to TOML and back; mistakes in them are named."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.errors import GrammarBTError, ParameterError, RunError
from grammarbt.run.spec import RunSpec, read_spec, settings_of

texts = st.text(min_size=1).filter(str.strip)
numbers = st.integers(1, 10**9)
values = st.one_of(st.text(), st.booleans(), st.integers(-(2**62), 2**62), st.floats(allow_nan=False))
settings = st.dictionaries(
    st.sampled_from(["searcher", "domain", "executor"]), st.dictionaries(st.text(min_size=1), values, max_size=3)
)
specs = st.builds(
    RunSpec,
    domain=texts,
    grammar=st.none() | texts,
    budget=numbers,
    seed=st.integers(0, 2**31 - 1),
    trials=st.none() | numbers,
    target=st.none() | st.floats(allow_nan=False, allow_infinity=False),
    stagnation=st.none() | numbers,
    snapshot=st.floats(0, 1e9),
    set=settings.map(lambda parts: {part: given for part, given in parts.items() if given}),
)


@given(spec=specs)
def test_a_spec_reads_back_from_its_toml(spec, tmp_path_factory):
    path = tmp_path_factory.mktemp("spec") / "spec.toml"
    path.write_text(spec.to_toml(), encoding="utf-8", newline="")
    assert read_spec(path) == spec


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("budget = -1", "budget cannot be -1"),
        ("budget = 'many'", "budget must be a whole number"),
        ("budget = true", "budget must be a whole number"),
        ("budgte = 5", "unknown field 'budgte'"),
        ("domain = 3", "domain must be a text"),
        ("stagnation = 0", "stagnation cannot be 0"),
        ("snapshot = -1", "snapshot cannot be -1"),
        ("selection = 0.95", "selection cannot be"),
        ("seed = 4000000000", "seed cannot be"),
        ("set = 3", "settings must be tables"),
        ("[set.searhcer]\nc = 1", "unknown part of a run"),
        ("budget = ", "is not TOML"),
    ],
)
def test_a_mistake_in_a_spec_is_named(tmp_path, content, message):
    path = tmp_path / "spec.toml"
    path.write_text(content)
    with pytest.raises(GrammarBTError, match=message):
        read_spec(path)


def test_a_missing_spec_is_named(tmp_path):
    with pytest.raises(RunError, match=r"nowhere\.toml"):
        read_spec(tmp_path / "nowhere.toml")


def test_options_given_win_over_the_file_and_others_do_not(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text("budget = 7\nseed = 3\n[set.searcher]\nc = 1.5\nk = 2")
    spec = read_spec(path).overridden({"budget": 9, "seed": None}, {"searcher": {"c": "2"}})
    assert (spec.budget, spec.seed, spec.settings("searcher")) == (9, 3, {"c": "2", "k": 2})


def test_the_two_shares_make_up_the_budget():
    spec = RunSpec(budget=5_000)
    assert (spec.search_episodes, spec.selection_episodes) == (4_500, 500)
    assert RunSpec(budget=1, selection=0.9).search_episodes == 1


@pytest.mark.parametrize("text", ["c=1", "searcher.c", "searcher.=1", "searhcer.c=1", ""])
def test_a_setting_that_cannot_be_read_is_named(text):
    with pytest.raises(ParameterError, match="setting"):
        settings_of([text])


def test_a_setting_may_hold_equal_signs_and_dots():
    assert settings_of(["domain.file.name=a=b"]) == {"domain": {"file.name": "a=b"}}
