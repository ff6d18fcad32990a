"""The kit passes for sound searchers, and finds every planted fault."""

import importlib.util
from pathlib import Path

import pytest

from grammarbt.testing import SEARCHER_CHECKS, SearcherConformance, SearcherSubject, verdicts
from grammarbt.testing.verdicts import name_of

FAULTY = Path(__file__).with_name("faulty_searchers.py")


def faults(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {name: thing.caught_by for name, thing in vars(module).items() if hasattr(thing, "caught_by")}


FAULTS = faults(FAULTY)


class TestRandomSearch(SearcherConformance):
    subject = SearcherSubject("random")


@pytest.mark.parametrize("fault", FAULTS)
def test_planted_fault_is_found_by_its_check(fault, tmp_path, monkeypatch):
    monkeypatch.setenv("GRAMMARBT_NOTES", str(tmp_path))
    subject = SearcherSubject(f"{FAULTY}:{fault}", seconds=8 if fault == "Stalls" else 60)
    check = next(check for check in SEARCHER_CHECKS if name_of(check) == FAULTS[fault])
    (verdict,) = verdicts([check], subject)
    assert verdict.status == "failed"
    assert verdict.seen
    assert verdict.advice


def test_every_check_has_a_fault_that_it_finds():
    assert set(FAULTS.values()) == {name_of(check) for check in SEARCHER_CHECKS}
