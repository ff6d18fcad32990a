"""The journal reads back exactly, cuts a torn line, and names damage."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.errors import RunError
from grammarbt.run.journal import Journal, read_journal

floats = st.floats(allow_nan=False, allow_infinity=False)
events = st.lists(st.fixed_dictionaries({"event": st.text(), "returns": st.lists(floats)}), max_size=5)


@given(batches=st.lists(events, max_size=4))
def test_everything_reads_back_exactly(batches, tmp_path_factory):
    path = tmp_path_factory.mktemp("journal") / "journal.jsonl"
    for batch in batches:
        journal = Journal.open(path)
        journal.append(batch)
        journal.close()
    assert read_journal(path) == [event for batch in batches for event in batch] if batches else not path.exists()


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "journal.jsonl"
    journal = Journal.open(path)
    journal.append({"event": "trial", "number": number} for number in range(5))
    journal.close()
    return path


def test_a_line_torn_anywhere_is_cut(path):
    whole = path.read_bytes()
    lines = whole.splitlines(keepends=True)
    for size in range(len(whole) - len(lines[-1]) + 1, len(whole)):
        path.write_bytes(whole[:size])
        assert len(read_journal(path)) == 4
        journal = Journal.open(path)
        journal.append([{"event": "trial", "number": 4}])
        journal.close()
        assert (
            path.read_bytes()
            == b"".join(lines[:-1])
            + json.dumps({"event": "trial", "number": 4}, separators=(",", ":")).encode()
            + b"\n"
        )


@pytest.mark.parametrize("damage", [b"{", b"\xff", b"[]", b'{"number":1}', b""])
def test_other_damage_names_the_line(path, damage):
    lines = path.read_bytes().splitlines()
    lines[2] = damage
    path.write_bytes(b"\n".join(lines) + b"\n")
    with pytest.raises(RunError, match="line 3"):
        read_journal(path)
    with pytest.raises(RunError, match="line 3"):
        Journal.open(path)


def test_a_journal_in_use_is_locked_until_it_is_closed(path):
    journal = Journal.open(path)
    with pytest.raises(RunError, match="in use"):
        Journal.open(path)
    journal.close()
    Journal.open(path).close()
