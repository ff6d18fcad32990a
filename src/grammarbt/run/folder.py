"""A run's folder: `spec.toml`, `run.json`, `journal.jsonl`, `timing.jsonl`, `snapshot.json` and `best.tree`."""

from __future__ import annotations

import contextlib
import json
import re
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias
from zlib import crc32

from attrs import frozen

from grammarbt.bt import format_tree
from grammarbt.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from grammarbt.bt import BehaviorTree
    from grammarbt.run.spec import RunSpec

RUNS = Path("runs")

Resolved: TypeAlias = "Mapping[str, object]"
"""What `run.json` says."""


@frozen
class RunFolder:
    """The files of one run."""

    path: Path

    @property
    def spec(self) -> Path:
        """What the user asked for."""
        return self.path / "spec.toml"

    @property
    def resolved(self) -> Path:
        """What that came to: versions, grammar, parameters."""
        return self.path / "run.json"

    @property
    def journal(self) -> Path:
        """All that happened."""
        return self.path / "journal.jsonl"

    @property
    def timing(self) -> Path:
        """When it happened."""
        return self.path / "timing.jsonl"

    @property
    def snapshot(self) -> Path:
        """Where a searcher that can say so stood, so that not all need be repeated."""
        return self.path / "snapshot.json"

    @property
    def best(self) -> Path:
        """The best tree, in the one-line notation."""
        return self.path / "best.tree"

    def save_best(self, tree: BehaviorTree) -> None:
        """Replace the best tree."""
        _replace(self.best, format_tree(tree) + "\n")

    def save_resolved(self, resolved: Resolved) -> None:
        """Replace `run.json`."""
        save_sealed(self.resolved, resolved, indent=2)

    def read_resolved(self) -> Resolved:
        """What `save_resolved` wrote.

        Raises:
            RunError: there is no run here, or its `run.json` is damaged.
        """
        try:
            return read_sealed(self.resolved)
        except OSError as error:
            raise RunError(
                f"cannot read {str(self.resolved)!r}: {error.strerror}", "give the folder of a run"
            ) from None


def save_sealed(path: Path, content: Resolved, indent: int | None = None) -> None:
    """Replace a JSON file, whose last entry says whether the others are as they were written."""
    _replace(path, json.dumps(_sealed(content), ensure_ascii=False, indent=indent) + "\n")


def read_sealed(path: Path) -> Resolved:
    """What `save_sealed` wrote.

    Raises:
        OSError: there is no such file.
        RunError: it is damaged.
    """
    try:
        found: object = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError):
        found = None
    content = {key: value for key, value in found.items() if key != "crc"} if isinstance(found, dict) else {}
    if not content or _sealed(content) != found:
        raise RunError(f"{path} is damaged", "restore the file from a backup")
    return content


def create_folder(spec: RunSpec, resolved: Resolved) -> RunFolder:
    """Make the folder of a new run and say in it what is run.

    Raises:
        RunError: the folder cannot be made or written, or holds something already.
    """
    path = _fresh(spec)
    try:
        path.mkdir(parents=True, exist_ok=True)
        if any(path.iterdir()):
            raise RunError(f"the run folder {str(path)!r} is not empty", "choose a new one with --out")
        folder = RunFolder(path)
        folder.spec.write_text(spec.to_toml(), encoding="utf-8")
        folder.save_resolved(resolved)
    except OSError as error:
        raise RunError(
            f"cannot write the run folder {str(path)!r}: {error.strerror}", "choose another one with --out"
        ) from None
    return folder


def _fresh(spec: RunSpec) -> Path:
    if spec.out is not None:
        return Path(spec.out)
    return next(path for path in _default_paths(spec) if not path.exists())


def _default_paths(spec: RunSpec) -> Iterator[Path]:
    domain = spec.domain.rpartition(":")[2]
    name = re.sub(r"[^\w.-]+", "-", f"{domain}-{spec.searcher}-s{spec.seed}")
    yield RUNS / name
    for number in count(2):
        yield RUNS / f"{name}-{number}"


def _replace(path: Path, text: str) -> None:
    """Replace a file; whoever reads meanwhile sees the old one or the new one, whole."""
    fresh = path.with_suffix(".new")
    try:
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):
            fresh.unlink(missing_ok=True)
        raise RunError(f"cannot write {str(path)!r}: {error.strerror}", "free some space") from None


def _sealed(resolved: Resolved) -> dict[str, object]:
    crc = crc32(json.dumps(resolved, sort_keys=True).encode())
    return {**resolved, "crc": f"{crc:08x}"}
