"""A run's folder: `spec.toml`, `run.json`, `journal.jsonl`, `timing.jsonl` and `best.tree`."""

from __future__ import annotations

import json
import re
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from attrs import frozen

from grammarbt.bt import format_tree
from grammarbt.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from grammarbt.bt import BehaviorTree
    from grammarbt.run.spec import RunSpec

RUNS = Path("runs")


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
    def best(self) -> Path:
        """The best tree, in the one-line notation."""
        return self.path / "best.tree"

    def save_best(self, tree: BehaviorTree) -> None:
        """Replace the best tree; whoever reads meanwhile sees the old one or the new one, whole."""
        fresh = self.best.with_suffix(".new")
        fresh.write_text(format_tree(tree) + "\n", encoding="utf-8")
        fresh.replace(self.best)


def create_folder(spec: RunSpec, resolved: Mapping[str, object]) -> RunFolder:
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
        folder.resolved.write_text(json.dumps(resolved, ensure_ascii=False, indent=2) + "\n", encoding="utf-8")
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
