"""The journal reads back exactly, cuts a torn line, and names damage."""

import os
import resource
from contextlib import closing, contextmanager

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.errors import RunError
from grammarbt.run.journal import Journal, encoded, read_journal

floats = st.floats(allow_nan=False, allow_infinity=False)
EVENTS = [{"event": "trial", "number": number} for number in range(5)]
events = st.lists(st.fixed_dictionaries({"event": st.text(), "returns": st.lists(floats)}), max_size=5)


def write(path, *batches, **options):
    with closing(Journal.open(path, **options)) as journal:
        for batch in batches:
            journal.append(map(encoded, batch))


@given(batches=st.lists(events, max_size=4))
def test_everything_reads_back_exactly_however_often_it_was_interrupted(batches, tmp_path_factory):
    path = tmp_path_factory.mktemp("journal") / "journal.jsonl"
    for stop in range(len(batches) + 1):
        write(path, *batches[:stop])
    assert read_journal(path) == [event for batch in batches for event in batch]


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "journal.jsonl"
    write(path, EVENTS)
    return path


def test_a_line_torn_anywhere_is_cut(path):
    whole = path.read_bytes()
    lines = whole.splitlines(keepends=True)
    for size in range(len(whole) - len(lines[-1]) + 1, len(whole)):
        path.write_bytes(whole[:size])
        assert len(read_journal(path)) == 4
        write(path, EVENTS)
        assert path.read_bytes() == whole


def test_what_is_repeated_must_be_the_same(path):
    whole = path.read_bytes()
    with pytest.raises(RunError, match="line 3: the run does not repeat itself"):
        write(path, [*EVENTS[:2], {"event": "trial", "number": 7}])
    assert path.read_bytes() == whole


def test_what_is_not_kept_is_cut_when_the_first_new_event_is_written(path):
    whole, told = path.read_bytes(), []
    write(path, EVENTS[:3], keep=3, extended=lambda: told.append(path.read_bytes()))
    assert (path.read_bytes(), told) == (whole, [])
    other = {"event": "trial", "number": 7}
    write(path, EVENTS[:3], [other], keep=3, extended=lambda: told.append(path.read_bytes()))
    assert told == [b"".join(whole.splitlines(keepends=True)[:3])]
    assert read_journal(path) == [*EVENTS[:3], other]


@pytest.mark.parametrize("damage", [b"{", b"\xff", b"[]", b'{"number":1}', b""])
def test_other_damage_names_the_line(path, damage):
    lines = path.read_bytes().splitlines()
    lines[2] = damage  # hence not the checksum that all lines before it ask for
    path.write_bytes(b"\n".join(lines) + b"\n")
    with pytest.raises(RunError, match="line 3"):
        read_journal(path)
    with pytest.raises(RunError, match="line 3"):
        Journal.open(path)


@given(data=st.data())
def test_no_changed_byte_goes_unnoticed(data, tmp_path_factory):
    path = tmp_path_factory.mktemp("journal") / "journal.jsonl"
    write(path, EVENTS)
    whole = bytearray(path.read_bytes())
    place = data.draw(st.integers(0, len(whole) - 2))
    whole[place] ^= data.draw(st.integers(1, 255))
    path.write_bytes(whole)
    with pytest.raises(RunError, match=f"line {1 + len(EVENTS) * place // len(whole)}: damaged"):
        read_journal(path)


def test_a_journal_in_use_is_locked_until_it_is_closed(path):
    journal = Journal.open(path)
    with pytest.raises(RunError, match="in use"):
        Journal.open(path)
    journal.close()
    Journal.open(path).close()


@pytest.fixture
def nobody(path):
    """A user who may read the journal and nothing more."""
    if os.geteuid() != 0:
        path.chmod(0o444)
        yield
        return
    for folder in list(path.parents)[:-2]:
        folder.chmod(folder.stat().st_mode | 0o055)
    os.seteuid(65534)
    yield
    os.seteuid(0)


@pytest.mark.usefixtures("nobody")
def test_a_journal_that_may_not_be_written_is_an_error(path):
    assert read_journal(path) == EVENTS
    with pytest.raises(RunError, match="Permission denied"):
        Journal.open(path)


def test_a_full_disk_is_an_error_and_what_was_written_before_stays(path):
    whole = path.read_bytes()
    with closing(Journal.open(path)) as journal, at_most(len(whole) + 70):
        journal.append(map(encoded, [*EVENTS, EVENTS[0]]))
        with pytest.raises(RunError, match="free some space"):
            journal.append(map(encoded, EVENTS))
    assert read_journal(path) == [*EVENTS, EVENTS[0]]


@contextmanager
def at_most(size):
    """No file may grow larger, as if the disk was full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
