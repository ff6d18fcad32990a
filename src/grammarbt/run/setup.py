"""From a spec to the parts of a run: domain, bound grammar, searcher."""

from __future__ import annotations

import platform
from concurrent.futures import Executor
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING
from zlib import crc32

import attrs
import numpy as np

from grammarbt import __version__
from grammarbt.bt import compile_policy
from grammarbt.domain import Domain
from grammarbt.errors import DomainError, GrammarError, RunError
from grammarbt.grammar import BoundGrammar, Source, bind, bundled, load_grammar, parse_tree
from grammarbt.plugins.parameters import build
from grammarbt.plugins.resolve import is_file_reference
from grammarbt.run.spec import RunSpec
from grammarbt.run.trees import load_tree
from grammarbt.run.worker import start_worker
from grammarbt.search import SearchContext, Searcher

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree
    from grammarbt.plugins import Registry


@attrs.frozen(eq=False)
class Setup:
    """The parts of a run, ready to go.

    Attributes:
        spec: as the user asked.
        domain: simulates.
        searcher: proposes.
        executor: runs simulations; to be shut down in the end.
        rng: the searcher's only source of randomness.
        resolved: what `run.json` says.
    """

    spec: RunSpec
    domain: Domain
    searcher: Searcher
    executor: Executor
    rng: np.random.Generator
    resolved: dict[str, object]


def prepare(spec: RunSpec, registry: Registry, kept: Source | None = None) -> Setup:
    """Make everything that a run needs, before anything is written.

    Args:
        spec: as the user asked.
        registry: makes the parts.
        kept: the grammar of a run that goes on, as its folder keeps it; its files may be gone or changed.

    Raises:
        GrammarBTError: a name, a parameter, the grammar or the start tree is wrong.
    """
    executor = _executor(spec, registry)
    registry.searcher_parameters(spec.searcher)
    domain = registry.make_domain(spec.domain, spec.settings("domain"))
    source = kept or _grammar_source(spec, domain, registry)
    grammar = bind(load_grammar(source), domain.vocabulary)
    context = _context(spec, domain, grammar, registry)
    searcher = registry.make_searcher(spec.searcher, context, spec.settings("searcher"))
    return Setup(spec, domain, searcher, executor, context.rng, _resolved(spec, source, grammar, registry))


def _executor(spec: RunSpec, registry: Registry) -> Executor:
    initializer = partial(start_worker, spec.domain, dict(spec.settings("domain")), registry.host.options)
    return registry.make_executor(spec.executor_name, spec.workers, initializer, spec.settings("executor"))


def _grammar_source(spec: RunSpec, domain: Domain, registry: Registry) -> Source:
    if spec.grammar is None:
        return registry.own_grammar(domain, spec.domain)
    return registry.find_grammar(spec.grammar)


def _context(spec: RunSpec, domain: Domain, grammar: BoundGrammar, registry: Registry) -> SearchContext:
    return SearchContext(
        grammar,
        domain.vocabulary,
        np.random.default_rng(np.random.SeedSequence(spec.seed).spawn(1)[0]),
        spec.search_episodes,
        domain.depends_on,
        None if spec.start is None else _start_tree(spec.start, domain, grammar, registry),
    )


def _start_tree(text: str, domain: Domain, grammar: BoundGrammar, registry: Registry) -> BehaviorTree:
    tree = load_tree(text, registry)
    try:
        compile_policy(tree, domain.vocabulary.index)
        parse_tree(grammar, tree)
    except (DomainError, GrammarError) as error:
        raise RunError(f"the start tree cannot be used: {error.message}", error.hint) from None
    return tree


def _resolved(spec: RunSpec, source: Source, grammar: BoundGrammar, registry: Registry) -> dict[str, object]:
    return {
        "versions": _versions(spec, registry),
        "spec": attrs.asdict(spec),
        "directory": str(Path.cwd()),
        "seed": spec.seed,
        "budget": spec.budget,
        "batch": spec.batch,
        "domain": {"name": spec.domain, "parameters": _domain_parameters(spec, registry)},
        "searcher": {"name": spec.searcher, "parameters": _searcher_parameters(spec, registry)},
        "grammar": {
            "name": source.name,
            "fingerprint": grammar.fingerprint,
            "text": source.text,
            "neighbours": bundled(source).neighbours,
        },
    }


def _versions(spec: RunSpec, registry: Registry) -> dict[str, str]:
    versions = {"python": platform.python_version(), "numpy": np.__version__, "grammarbt": __version__}
    used = [plugin for plugin in registry.host.plugins if plugin.status == "ok"]
    files = [name.rpartition(":")[0] for name in (spec.domain, spec.searcher) if is_file_reference(name)]
    digests = {name: f"{crc32(Path(name).read_bytes()):08x}" for name in files}
    return {**versions, **{plugin.distribution: plugin.version for plugin in used}, **digests}


def _searcher_parameters(spec: RunSpec, registry: Registry) -> dict[str, object]:
    parameters = registry.searcher_parameters(spec.searcher)
    return attrs.asdict(build(parameters, spec.settings("searcher"), "searcher"))


def _domain_parameters(spec: RunSpec, registry: Registry) -> dict[str, object]:
    if is_file_reference(spec.domain):
        return dict(spec.settings("domain"))
    parameters = registry.parameters_of(registry.domain(spec.domain))
    return attrs.asdict(build(parameters, spec.settings("domain"), "domain"))
