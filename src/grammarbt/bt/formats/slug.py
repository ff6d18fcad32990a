"""Names for machines: an XML tag for every leaf.

Letters, digits and `_` stay, a space becomes `_`, anything else becomes `-` and its number in hexadecimal. So a leaf has
the same tag in every tree, unless two leaves of a tree would share one; then the later in alphabetical order is numbered.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grammarbt.bt.model import Action, BehaviorTree, Condition, Leaf, leaves

if TYPE_CHECKING:
    from collections.abc import Collection

_PLAIN = re.compile(r"[A-Za-z0-9_]")
_START = re.compile(r"[A-Za-z_]")


def slug(name: str, reserved: Collection[str] = ()) -> str:
    """The name as an XML name of ASCII letters, digits, `_` and `-`.

    Those in `reserved`, which is in lower case, get a `_` behind.
    """
    found = "".join(char if _PLAIN.match(char) else "_" if char == " " else f"-{ord(char):x}-" for char in name)
    if not _START.match(found):
        found = f"_{found}"
    return f"{found}_" if found.lower() in reserved else found


def tags(tree: BehaviorTree, reserved: Collection[str]) -> dict[tuple[type[Leaf], str], str]:
    """A tag for each kind and name of the tree's leaves; leaves that differ in their arguments share one."""
    found: dict[tuple[type[Leaf], str], str] = {}
    taken: set[str] = set()
    for kind in (Action, Condition):
        for name in sorted({leaf.name for leaf in leaves(tree) if isinstance(leaf, kind)}):
            tag = _free(slug(name, reserved), taken)
            taken.add(tag)
            found[kind, name] = tag
    return found


def is_tag_of(tag: str, name: str, reserved: Collection[str]) -> bool:
    """Whether `tags` could have given `tag` to a leaf called `name`."""
    plain = slug(name, reserved)
    return tag == plain or (tag.startswith(f"{plain}_") and tag[len(plain) + 1 :].isdecimal())


def _free(tag: str, taken: set[str]) -> str:
    number, candidate = 1, tag
    while candidate in taken:
        number += 1
        candidate = f"{tag}_{number}"
    return candidate
