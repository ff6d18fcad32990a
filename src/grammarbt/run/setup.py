"""From a spec to the parts of a run: domain, bound grammar, searcher."""

from __future__ import annotations

import platform
from concurrent.futures import Executor
from functools import partial
from typing import TYPE_CHECKING

import attrs
import numpy as np

from grammarbt import __version__
from grammarbt.bt import compile_policy
from grammarbt.domain import Domain
from grammarbt.errors import DomainError
from grammarbt.grammar import BoundGrammar, Source, bind, load_grammar
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
        resolved: what `run.json` says.
    """

    spec: RunSpec
    domain: Domain
    searcher: Searcher
    executor: Executor
    resolved: dict[str, object]


def prepare(spec: RunSpec, registry: Registry) -> Setup:
    """Make everything that a run needs, before anything is written.

    Raises:
        GrammarBTError: a name, a parameter, the grammar or the start tree is wrong.
    """
    executor = _executor(spec, registry)
    registry.searcher(spec.searcher)
    domain = registry.make_domain(spec.domain, spec.settings("domain"))
    source = _grammar_source(spec, domain, registry)
    grammar = bind(load_grammar(source), domain.vocabulary)
    searcher = registry.make_searcher(
        spec.searcher, _context(spec, domain, grammar, registry), spec.settings("searcher")
    )
    return Setup(spec, domain, searcher, executor, _resolved(spec, source, grammar, registry))


def _executor(spec: RunSpec, registry: Registry) -> Executor:
    initializer = partial(start_worker, spec.domain, dict(spec.settings("domain")), registry.host.options)
    return registry.make_executor(spec.executor_name, spec.workers, initializer, spec.settings("executor"))


def _grammar_source(spec: RunSpec, domain: Domain, registry: Registry) -> Source:
    if spec.grammar is None and ":" in domain.grammar and "\n" in domain.grammar:
        return Source(f"the grammar of {spec.domain}", domain.grammar)
    return registry.find_grammar(spec.grammar or domain.grammar)


def _context(spec: RunSpec, domain: Domain, grammar: BoundGrammar, registry: Registry) -> SearchContext:
    return SearchContext(
        grammar,
        domain.vocabulary,
        np.random.default_rng(np.random.SeedSequence(spec.seed).spawn(1)[0]),
        spec.search_episodes,
        domain.depends_on,
        None if spec.start is None else _start_tree(spec.start, domain, registry),
    )


def _start_tree(text: str, domain: Domain, registry: Registry) -> BehaviorTree:
    tree = load_tree(text, registry)
    try:
        compile_policy(tree, domain.vocabulary.index)
    except DomainError as error:
        raise DomainError(f"the start tree cannot be used: {error.message}", error.hint) from None
    return tree


def _resolved(spec: RunSpec, source: Source, grammar: BoundGrammar, registry: Registry) -> dict[str, object]:
    return {
        "versions": _versions(registry),
        "spec": attrs.asdict(spec),
        "seed": spec.seed,
        "budget": spec.budget,
        "batch": spec.batch,
        "domain": {"name": spec.domain, "parameters": _domain_parameters(spec, registry)},
        "searcher": {"name": spec.searcher, "parameters": _searcher_parameters(spec, registry)},
        "grammar": {"name": source.name, "fingerprint": grammar.fingerprint, "text": source.text},
    }


def _versions(registry: Registry) -> dict[str, str]:
    versions = {"python": platform.python_version(), "numpy": np.__version__, "grammarbt": __version__}
    used = [plugin for plugin in registry.host.plugins if plugin.status == "ok"]
    return {**versions, **{plugin.distribution: plugin.version for plugin in used}}


def _searcher_parameters(spec: RunSpec, registry: Registry) -> dict[str, object]:
    parameters = registry.parameters_of(registry.searcher(spec.searcher))
    return attrs.asdict(build(parameters, spec.settings("searcher"), "searcher"))


def _domain_parameters(spec: RunSpec, registry: Registry) -> dict[str, object]:
    if is_file_reference(spec.domain):
        return dict(spec.settings("domain"))
    parameters = registry.parameters_of(registry.domain(spec.domain))
    return attrs.asdict(build(parameters, spec.settings("domain"), "domain"))
