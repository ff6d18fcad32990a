"""What a plugin says about its components; light, so that listing them imports no simulator and no searcher."""

from __future__ import annotations

from attrs import frozen

GRAMMARBT_API = 1
"""The number of the plugin interface; a plugin's hooks module may state the one it was written for."""


@frozen
class DomainSpec:
    """A simulator.

    Attributes:
        name: what users type.
        factory: dotted path `"package.module:Class"`, called with an instance of the parameters.
        parameters: dotted path of the attrs class of its parameters.
        help: one sentence.
    """

    name: str
    factory: str
    parameters: str = "grammarbt.domain:NoParameters"
    help: str = ""


@frozen
class SearcherSpec:
    """A search method.

    Attributes:
        name: what users type.
        factory: dotted path `"package.module:Class"`, called with a `SearchContext` and the parameters.
        parameters: dotted path of the attrs class of its parameters.
        help: one sentence, naming the paper.
    """

    name: str
    factory: str
    parameters: str = "grammarbt.domain:NoParameters"
    help: str = ""


@frozen
class GrammarSpec:
    """A grammar file shipped in a package.

    Attributes:
        name: what users type.
        package: the package that carries the file.
        resource: the file's path inside the package.
        help: one sentence.
    """

    name: str
    package: str
    resource: str
    help: str = ""


@frozen
class ExecutorSpec:
    """A way to run simulations side by side.

    Attributes:
        name: what users type.
        factory: dotted path, called with the number of workers, an initializer to call once in each worker process,
            and the parameters; gives a `concurrent.futures.Executor`.
        parameters: dotted path of the attrs class of its parameters.
        help: one sentence.
    """

    name: str
    factory: str
    parameters: str = "grammarbt.domain:NoParameters"
    help: str = ""


@frozen
class FormatSpec:
    """A file format of behavior trees.

    Attributes:
        name: what users type.
        suffixes: file name endings, with the dot.
        exporter: dotted path of `(BehaviorTree) -> str | bytes`, or None.
        importer: dotted path of `(str) -> BehaviorTree`, or None.
        help: one sentence.
    """

    name: str
    suffixes: tuple[str, ...] = ()
    exporter: str | None = None
    importer: str | None = None
    help: str = ""
