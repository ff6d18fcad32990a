"""The registry: from the names users type to the components behind them.

Descriptions are light; what they describe is imported when it is made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar, cast

import attrs

from grammarbt.errors import DomainError, GrammarBTError, PluginError, UnknownNameError
from grammarbt.plugins import parameters
from grammarbt.plugins.resolve import is_file_reference, load, load_from_file, one_line
from grammarbt.plugins.specs import DomainSpec, ExecutorSpec, FormatSpec, GrammarSpec, SearcherSpec

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from grammarbt.domain import Domain
    from grammarbt.grammar.diagnostics import Source
    from grammarbt.plugins.host import PluginHost
    from grammarbt.search.base import SearchContext, Searcher

AnySpec = TypeVar("AnySpec", SearcherSpec, DomainSpec, GrammarSpec, ExecutorSpec, FormatSpec)
Settings = Mapping[str, object]

_DOMAIN_MEMBERS = ("vocabulary", "grammar", "references", "depends_on", "simulate")


class Registry:
    """Every component of the core and of the plugins in use, by name.

    Args:
        host: has loaded the plugins.
    """

    def __init__(self, host: PluginHost) -> None:
        self.host = host
        self._domains = self._table("domains", DomainSpec)
        self._searchers = self._table("searchers", SearcherSpec)
        self._grammars = self._table("grammars", GrammarSpec)
        self._executors = self._table("executors", ExecutorSpec)
        self._formats = self._table("formats", FormatSpec)

    @property
    def formats(self) -> tuple[FormatSpec, ...]:
        """Every tree format, by name."""
        return tuple(self._formats[name] for name in sorted(self._formats))

    def domain(self, name: str) -> DomainSpec:
        """The domain of that name, or an `UnknownNameError` with the nearest names."""
        return _lookup("domain", self._domains, name)

    def searcher(self, name: str) -> SearcherSpec:
        """The searcher of that name, or an `UnknownNameError` with the nearest names."""
        return _lookup("searcher", self._searchers, name)

    def executor(self, name: str) -> ExecutorSpec:
        """The executor of that name, or an `UnknownNameError` with the nearest names."""
        return _lookup("executor", self._executors, name)

    def format(self, name: str) -> FormatSpec:
        """The tree format of that name, or an `UnknownNameError` with the nearest names."""
        return _lookup("format", self._formats, name)

    def parameters_of(self, spec: DomainSpec | SearcherSpec | ExecutorSpec) -> type:
        """The attrs class of a component's parameters, imported."""
        return cast("type", load(spec.parameters, self._owner(spec)))

    def make_domain(self, name: str, settings: Settings) -> Domain:
        """A domain by name, or from a plain file as `FILE.py:NAME`.

        The settings of a class in a file are its own fields, if it is an attrs class; other classes take none.

        Raises:
            UnknownNameError: nothing is called so.
            DomainError: the file cannot be used, or the object lacks what makes a domain.
            ParameterError: a setting is wrong.
            PluginError: the plugin breaks while making it.
        """
        made = (
            _from_file(name, settings) if is_file_reference(name) else self._make("domain", self.domain(name), settings)
        )
        for member in _DOMAIN_MEMBERS:
            if not hasattr(made, member):
                raise DomainError(f"domain {name!r} has no {member!r}", "see grammarbt.domain.Domain for what it needs")
        return cast("Domain", made)

    def make_searcher(self, name: str, context: SearchContext, settings: Settings) -> Searcher:
        """A searcher by name, or from a plain file as `FILE.py:NAME`, ready to be asked.

        A class in a file names the attrs class of its parameters as its attribute `Parameters`; others take none.

        Raises:
            UnknownNameError: nothing is called so.
            DomainError: the file cannot be used.
            ParameterError: a setting is wrong.
            PluginError: the plugin breaks while making it.
        """
        if is_file_reference(name):
            chosen: object = parameters.build(self.searcher_parameters(name), settings, "searcher")
            factory = cast("Callable[..., object]", load_from_file(name))
            return cast("Searcher", _called(f"searcher {name!r}", factory, context, chosen))
        return cast("Searcher", self._make("searcher", self.searcher(name), settings, context))

    def searcher_parameters(self, name: str) -> type:
        """The attrs class of the parameters of the searcher of that name, or in that file."""
        if is_file_reference(name):
            return cast("type", getattr(load_from_file(name), "Parameters", _no_parameters()))
        return self.parameters_of(self.searcher(name))

    def make_executor(self, name: str, workers: int, initializer: Callable[[], object], settings: Settings) -> Executor:
        """An executor by name; `initializer` is called in each worker process before anything else.

        Raises:
            UnknownNameError: nothing is called so.
            ParameterError: a setting is wrong, or the executor cannot have so many workers.
            PluginError: the plugin breaks while making it.
        """
        return cast("Executor", self._make("executor", self.executor(name), settings, workers, initializer))

    def own_grammar(self, domain: Domain, name: str) -> Source:
        """The default grammar of the domain of that name, which may give its text instead of a grammar's name."""
        from grammarbt.grammar.diagnostics import Source  # noqa: PLC0415 - as in find_grammar

        if ":" in domain.grammar and "\n" in domain.grammar:
            return Source(f"the grammar of {name}", domain.grammar)
        return self.find_grammar(domain.grammar)

    def find_grammar(self, name_or_path: str) -> Source:
        """A grammar's text, by the name of one that a plugin or grammarbt ships, or by its path.

        Raises:
            UnknownNameError: it is neither.
            GrammarError: the file cannot be read.
            PluginError: the plugin lacks the file it promises.
        """
        from grammarbt.grammar import read_source, shipped_grammars  # noqa: PLC0415 - brings lark, which listing plugins does not need

        shipped = shipped_grammars()
        if name_or_path in self._grammars:
            return self._plugin_grammar(self._grammars[name_or_path])
        if name_or_path in shipped:
            return shipped[name_or_path]
        if Path(name_or_path).suffix or Path(name_or_path).is_file():
            return read_source(Path(name_or_path))
        raise UnknownNameError("grammar", name_or_path, [*self._grammars, *shipped])

    def _table(self, kind: str, spec_type: type[AnySpec]) -> dict[str, AnySpec]:
        specs = (spec for plugin in self.host.plugins for spec in plugin.provides[kind])
        return {spec.name: spec for spec in specs if isinstance(spec, spec_type)}

    def _make(
        self, kind: str, spec: DomainSpec | SearcherSpec | ExecutorSpec, settings: Settings, *arguments: object
    ) -> object:
        owner = self._owner(spec)
        chosen: object = parameters.build(self.parameters_of(spec), settings, kind)
        factory = cast("Callable[..., object]", load(spec.factory, owner))
        return _called(f"{kind} {spec.name!r} of {owner}", factory, *arguments, chosen)

    def _owner(self, spec: object) -> str:
        owners = (str(plugin) for plugin in self.host.plugins for specs in plugin.provides.values() if spec in specs)
        return next(owners)

    def _plugin_grammar(self, spec: GrammarSpec) -> Source:
        from grammarbt.grammar.diagnostics import Source  # noqa: PLC0415 - as in find_grammar

        try:
            text = resources.files(spec.package).joinpath(spec.resource).read_text(encoding="utf-8")
        except Exception as error:
            raise PluginError(f"{self._owner(spec)} lacks its grammar {spec.name!r}: {one_line(error)}") from error
        return Source(spec.name, text)


def _lookup(kind: str, table: Mapping[str, AnySpec], name: str) -> AnySpec:
    if name not in table:
        raise UnknownNameError(kind, name, table)
    return table[name]


def _called(what: str, factory: Callable[..., object], *arguments: object) -> object:
    try:
        return factory(*arguments)
    except GrammarBTError:
        raise
    except Exception as error:
        raise PluginError(f"{what} cannot be made: {one_line(error)}", "--traceback shows where it broke") from error


def _from_file(reference: str, settings: Settings) -> object:
    found = load_from_file(reference)
    if isinstance(found, type) and attrs.has(found):
        return parameters.build(found, settings, "domain")
    parameters.build(_no_parameters(), settings, "domain")
    return _called(f"domain {reference!r}", found) if isinstance(found, type) else found


def _no_parameters() -> type:
    from grammarbt.domain import NoParameters  # noqa: PLC0415 - brings numpy, which listing plugins does not need

    return NoParameters
