"""Benchmarks: searchers × domains × seeds at equal budget, each a run of its own, over a pool of processes.

A bench can be interrupted and called again: finished runs are kept, others go on where they stopped.
"""

from __future__ import annotations

import multiprocessing
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from attrs import field, frozen
from attrs.validators import ge

from grammarbt.errors import GrammarBTError, ParameterError
from grammarbt.run.execute import execute
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import iterate_journal
from grammarbt.run.resume import Changes, resume
from grammarbt.run.setup import prepare
from grammarbt.run.spec import RunSpec, read_toml
from grammarbt.run.watch import Watcher

if TYPE_CHECKING:
    from grammarbt.plugins import PluginOptions

_FIRST_SEED, _SEEDS = 100, 20
_RANGE = 2


@frozen
class Contestant:
    """A searcher or a domain with its parameters.

    Attributes:
        name: what users type.
        label: what tables call it.
        grammar: for a domain, another grammar than its own.
        set: its parameters.
    """

    name: str
    label: str = field(default="")
    grammar: str | None = None
    set: Mapping[str, object] = field(factory=dict)

    @property
    def title(self) -> str:
        """The label, or the name with what was set."""
        settings = ",".join(f"{key}={value}" for key, value in self.set.items())
        return self.label or (f"{self.name}({settings})" if settings else self.name)


def _contestants(entries: Sequence[Mapping[str, object]]) -> tuple[Contestant, ...]:
    return tuple(Contestant(**cast("Any", entry)) for entry in entries)


def _distinct(_: object, attribute: object, entries: tuple[Contestant, ...]) -> None:
    titles = [entry.title for entry in entries]
    if not titles or len(set(titles)) < len(titles):
        raise ParameterError(
            f"{getattr(attribute, 'name', '')}: every entry needs a title of its own", "give each a label"
        )


@frozen
class BenchSpec:
    """A bench, as its TOML file says.

    Attributes:
        searcher: who competes.
        domain: on what.
        budget: episodes of each run.
        seeds: the first, and the one after the last; or all of them.
        batch: trees asked for at a time.
        validation: fresh worlds that final trees are scored on.
        curve: fresh worlds that each point of an anytime curve is scored on; 0 for no curves.
        target: share of the reference's value that counts as reached.
        workers: runs side by side.
        out: folder of the runs and the tables; beside the spec, under its name, unless given.
    """

    searcher: tuple[Contestant, ...] = field(converter=_contestants, validator=_distinct)
    domain: tuple[Contestant, ...] = field(converter=_contestants, validator=_distinct)
    budget: int = field(default=5_000, validator=ge(1))
    seeds: tuple[int, ...] = field(default=(_FIRST_SEED, _FIRST_SEED + _SEEDS), converter=tuple)
    batch: int = field(default=1, validator=ge(1))
    validation: int = field(default=2_000, validator=ge(2))
    curve: int = field(default=500, validator=ge(0))
    target: float = 0.95
    workers: int = field(default=os.cpu_count() or 1, validator=ge(1))
    out: str = ""

    @property
    def run_seeds(self) -> tuple[int, ...]:
        """Every seed."""
        return tuple(range(*self.seeds)) if len(self.seeds) == _RANGE else self.seeds


@frozen
class Cell:
    """One run of a bench."""

    domain: str
    searcher: str
    seed: int
    spec: RunSpec

    @property
    def folder(self) -> RunFolder:
        """Its folder."""
        return RunFolder(Path(self.spec.out or ""))


def read_bench(path: Path) -> BenchSpec:
    """Read a bench's TOML file.

    Raises:
        RunError: the file cannot be read, or is not TOML.
        ParameterError: a field is unknown or has a wrong value.
    """
    content = read_toml(path, BenchSpec, "grammarbt bench")
    try:
        return BenchSpec(**{"out": str(path.with_suffix("")), **content})
    except (TypeError, ValueError) as error:
        raise ParameterError(f"{path}: {error}", "see 'grammarbt bench --help' for an example") from None
    except ParameterError as error:
        raise ParameterError(f"{path}: {error.message}", error.hint) from None


def cells(spec: BenchSpec) -> tuple[Cell, ...]:
    """Every run of a bench: seed by seed, so that a table of few seeds is there early."""
    return tuple(
        Cell(domain.title, searcher.title, seed, _run_spec(spec, domain, searcher, seed))
        for seed in spec.run_seeds
        for domain in spec.domain
        for searcher in spec.searcher
    )


def run_cells(todo: Sequence[Cell], workers: int, options: PluginOptions) -> Iterator[tuple[Cell, str]]:
    """Bring every run to its end; yields each when it is done, with the reason if it failed."""
    context = multiprocessing.get_context("forkserver")
    with ProcessPoolExecutor(min(workers, len(todo)) or 1, context) as pool:
        futures = {pool.submit(run_cell, cell, options): cell for cell in todo}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def is_finished(folder: RunFolder) -> bool:
    """Whether a run went to its end."""
    if not folder.journal.exists():
        return False
    return any(event["event"] == "finished" for event in iterate_journal(folder.journal))


def run_cell(cell: Cell, options: PluginOptions) -> str:
    """Begin a run, or go on with it; gives what went wrong, or nothing."""
    from grammarbt.plugins import PluginHost, Registry  # noqa: PLC0415 - loaded in each worker process

    registry = Registry(PluginHost(options, _silent))
    try:
        if cell.folder.resolved.exists():
            resume(cell.folder, Changes(), registry, Watcher(), _silent)
        else:
            execute(prepare(cell.spec, registry), Watcher())
    except GrammarBTError as error:
        return str(error)
    return ""


def _silent(_: str) -> None:
    """Warnings of many runs at once would help nobody."""


def _run_spec(spec: BenchSpec, domain: Contestant, searcher: Contestant, seed: int) -> RunSpec:
    out = Path(spec.out) / _slug(domain.title) / _slug(searcher.title) / f"s{seed}"
    return RunSpec(
        domain=domain.name,
        searcher=searcher.name,
        grammar=domain.grammar,
        budget=spec.budget,
        seed=seed,
        batch=spec.batch,
        validation=spec.validation,
        out=str(out),
        set={"domain": dict(domain.set), "searcher": dict(searcher.set)},
    )


def _slug(title: str) -> str:
    return re.sub(r"[^\w.=-]+", "-", title).strip("-")
