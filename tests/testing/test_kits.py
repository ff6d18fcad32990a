"""The kits pass for a sound domain and a sound searcher, and find every planted fault."""

import importlib.util
from pathlib import Path

import pytest

from grammarbt.testing import (
    DOMAIN_CHECKS,
    SEARCHER_CHECKS,
    DomainConformance,
    DomainSubject,
    SearcherConformance,
    SearcherSubject,
    verdicts,
)
from grammarbt.testing.verdicts import name_of

WORLDS = Path(importlib.util.find_spec("grammarbt.testing.worlds").origin)
NEVER_ENDING = {"EndlessElsewhere", "Stalls"}


def faults(path):
    """The classes of a file by their names, each with the name of the check that is to find its fault."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {name: thing.caught_by for name, thing in vars(module).items() if hasattr(thing, "caught_by")}


KITS = {
    Path(__file__).with_name("faulty_domains.py"): (DOMAIN_CHECKS, DomainSubject),
    Path(__file__).with_name("faulty_searchers.py"): (SEARCHER_CHECKS, SearcherSubject),
}
FAULTS = [(path, fault, caught_by) for path in KITS for fault, caught_by in faults(path).items()]


class TestSoundDomain(DomainConformance):
    subject = DomainSubject(f"{WORLDS}:Lamps")


class TestRandomSearch(SearcherConformance):
    subject = SearcherSubject("random")


@pytest.mark.parametrize(("path", "fault", "caught_by"), FAULTS, ids=[fault for _, fault, _ in FAULTS])
def test_planted_fault_is_found_by_its_check(path, fault, caught_by, tmp_path, monkeypatch):
    monkeypatch.setenv("GRAMMARBT_NOTES", str(tmp_path))
    checks, subject = KITS[path]
    check = next(check for check in checks if name_of(check) == caught_by)
    (verdict,) = verdicts([check], subject(f"{path}:{fault}", seconds=8 if fault in NEVER_ENDING else 60))
    assert verdict.status == "failed"
    assert verdict.seen
    assert verdict.advice


@pytest.mark.parametrize("path", KITS, ids=lambda path: path.stem)
def test_every_check_has_a_fault_that_it_finds(path):
    assert set(faults(path).values()) == {name_of(check) for check in KITS[path][0]}
