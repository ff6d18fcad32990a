"""The page on the protocol lists every key."""

import re
from pathlib import Path

import attrs
import pytest

from grammarbt.domain import Episode, Frame, Mark, Role, Shape
from grammarbt_exec.announcement import AnnouncedAction, AnnouncedCondition, Announcement

PAGE = (Path(__file__).parents[3] / "docs" / "reference" / "exec-protocol.md").read_text(encoding="utf-8")
TABLES = [
    re.findall(r"^\| (`.*?) +\|(.*)\|$", table, re.MULTILINE)
    for table in re.split(r"^\| --- .*\n", PAGE, flags=re.MULTILINE)[1:]
]
KEYS = [[key for cell, _ in rows for key in re.findall(r"`(\w+)`", cell)] for rows in TABLES]


@pytest.mark.parametrize(
    ("kinds", "more"),
    [
        ([Announcement], []),
        ([AnnouncedAction, AnnouncedCondition], []),
        ([Episode], ["id"]),
        ([Frame], []),
        ([Mark], []),
    ],
    ids=lambda value: value[0].__name__ if value and isinstance(value[0], type) else "",
)
def test_a_table_has_the_keys_that_are_read(kinds, more):
    names = [field.name for kind in kinds for field in attrs.fields(kind)]
    assert sorted({*names, *more}) in [sorted(keys) for keys in KEYS]


def test_the_shapes_and_roles_are_those_that_are_drawn():
    (marks,) = (dict(rows) for rows, keys in zip(TABLES, KEYS, strict=True) if "shape" in keys)
    for key, kind in (("`shape`", Shape), ("`role`", Role)):
        assert re.findall(r'"(\w+)"', marks[key]) == list(kind.__args__)
