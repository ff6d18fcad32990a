"""Which installed distributions announce a plugin; reads metadata only, imports nothing of theirs."""

from __future__ import annotations

import re
from importlib.metadata import Distribution, EntryPoint, distributions
from typing import TYPE_CHECKING

from attrs import frozen

from grammarbt.errors import PluginError

if TYPE_CHECKING:
    from collections.abc import Iterator

ENTRY_POINT_GROUP = "grammarbt"


@frozen
class Announcement:
    """One plugin as its distribution's metadata announce it.

    Attributes:
        name: the entry point's name.
        distribution: the distribution's name, as packaged.
        version: the distribution's version.
        entry_point: what to load, or None when the metadata cannot be read.
        error: why there is no entry point.
    """

    name: str
    distribution: str
    version: str
    entry_point: EntryPoint | None = None
    error: str = ""

    def load(self) -> object:
        """Import the plugin.

        Raises:
            PluginError: the metadata cannot be read; everything else comes from the plugin.
        """
        if self.entry_point is None:
            raise PluginError(self.error)
        return self.entry_point.load()


def announcements() -> list[Announcement]:
    """Every announced plugin, sorted by name and distribution.

    A distribution that is on the path twice counts once, as for `import`: the first one wins.
    """
    found: dict[str, list[Announcement]] = {}
    for distribution in distributions():
        announced = list(_announced_by(distribution))
        if announced:
            found.setdefault(_normalized(announced[0].distribution), announced)
    every = [announcement for announced in found.values() for announcement in announced]
    return sorted(every, key=lambda announcement: (announcement.name, announcement.distribution))


def _announced_by(distribution: Distribution) -> Iterator[Announcement]:
    # Metadata are a stranger's files: whatever is wrong with them must not stop the other plugins.
    try:
        text = distribution.read_text("entry_points.txt") or ""
        group = distribution.entry_points.select(group=ENTRY_POINT_GROUP) if f"[{ENTRY_POINT_GROUP}]" in text else ()
    except Exception as error:  # noqa: BLE001
        name, version = _identity(distribution)
        yield Announcement(name, name, version, error=f"unreadable entry points: {type(error).__name__}: {error}")
        return
    for entry_point in group:
        yield Announcement(entry_point.name, *_identity(distribution), entry_point)


def _identity(distribution: Distribution) -> tuple[str, str]:
    try:
        return distribution.name or "unknown", distribution.version or "unknown"
    except Exception:  # noqa: BLE001 - a half-deleted METADATA file; the entry point's name still identifies the plugin
        return "unknown", "unknown"


def _normalized(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()
