"""`%import`: the rules a grammar takes from other grammars, with everything these rules need.

An imported rule keeps its name, or gets its alias. What it needs besides comes along as `file__rule`; so do the
directives that concern it.
"""

from __future__ import annotations

from pathlib import Path

from grammarbt.errors import GrammarError, did_you_mean
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Source
from grammarbt.grammar.link import Key, Linker, Module
from grammarbt.grammar.reader import read
from grammarbt.grammar.shipped import shipped_grammars
from grammarbt.grammar.syntax import Import, Item

MAX_FILES = 100
MAX_CHAIN = 30


def read_source(path: Path) -> Source:
    """The text of a grammar file.

    Raises:
        GrammarError: it cannot be read.
    """
    try:
        return Source(str(path), path.read_text(encoding="utf-8"), path.parent)
    except (OSError, UnicodeDecodeError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is not text in UTF-8"
        raise GrammarError(
            f"cannot read the grammar {str(path)!r}: {reason}", "give the path of a .grammar file"
        ) from None


def with_imports(source: Source, items: tuple[Item, ...]) -> tuple[Item, ...]:
    """The items of a file followed by those it imports; a file without `%import` stays as it is.

    Raises:
        GrammarFileError: with code G102 (too many files), G106 (no such grammar), G107 (a path out of the folder),
            G108 (a circle) or G109 (no such rule).
    """
    if not any(isinstance(item, Import) for item in items):
        return items
    loader = _Loader()
    main = loader.load(source, items)
    if loader.findings:
        raise GrammarFileError(loader.findings)
    return tuple(Linker(main, loader.modules).items())


def bundled(source: Source) -> Source:
    """The file together with the texts of the neighbours that it imports from, so that it can be read anywhere.

    Raises:
        GrammarFileError: it is not a grammar.
    """
    loader = _Loader()
    loader.load(source, read(source))
    beside = {key[1]: other.text for key, other in loader.sources.items() if key[0] and other != source}
    return Source(source.name, source.text, neighbours=beside)


class _Loader:
    """Reads each file once."""

    def __init__(self) -> None:
        self.modules: dict[Key, Module] = {}
        self.sources: dict[Key, Source] = {}
        self.findings: list[Diagnostic] = []
        self.chain: list[Key] = []

    def load(self, source: Source, items: tuple[Item, ...]) -> Module:
        key = _key(source)
        module = self.modules[key] = Module(key, items)
        self.sources[key] = source
        self.chain.append(key)
        for item in items:
            if isinstance(item, Import):
                self._follow(module, item, source)
        self.chain.pop()
        return module

    def _follow(self, module: Module, item: Import, source: Source) -> None:
        """Load what an import names, and note the rules; whatever is wrong becomes a finding at the import."""
        try:
            other = self._other(item, source)
        except GrammarFileError as error:
            self.findings += error.diagnostics
            return
        known = [*other.rules, *other.wanted]
        for rule, alias in item.rules:
            if rule in other.rules or rule in other.imported:
                module.imported[alias] = (other, rule)
            elif rule not in known:  # what it wanted and did not get has its own finding
                message = f"the grammar `{other.key[1]}` has no rule `{rule}`"
                self.findings.append(Diagnostic("G109", message, item.span, did_you_mean(rule, known)))

    def _other(self, item: Import, importer: Source) -> Module:
        if item.level > 1 or len(item.module) > 1:
            help_ = "import from a shipped grammar, as in `%import scheide.subtree`, or from a neighbouring file"
            raise _failure("G107", "an import stays in the folder of its file", item, help_)
        if not item.module:
            raise _failure("G106", "this import names no grammar", item, "write `%import name.rule`")
        source = _find(item.module[0], importer, item)
        key = _key(source)
        if key in self.chain:
            raise _failure(
                "G108", f"the grammar `{key[1]}` imports itself", item, "move what both need to a third file"
            )
        if key in self.modules:
            return self.modules[key]
        if len(self.modules) >= MAX_FILES or len(self.chain) >= MAX_CHAIN:
            raise _failure("G102", f"more than {MAX_FILES} files, or {MAX_CHAIN} in a chain", item, "join some")
        return self.load(source, read(source))


def _key(source: Source) -> Key:
    folder = "." if source.neighbours is not None else str(source.folder or "")
    return folder, Path(source.name).stem


def _find(name: str, importer: Source, item: Import) -> Source:
    if item.level and importer.neighbours is not None:
        return _bundled_neighbour(name, importer, item)
    if item.level and importer.folder is not None:
        return _neighbour(name, importer.folder, item)
    if name not in shipped_grammars():
        help_ = f"{did_you_mean(name, shipped_grammars())}; a file of yours is `.{name}`"
        raise _failure("G106", f"no shipped grammar is called `{name}`", item, help_)
    return shipped_grammars()[name]


def _bundled_neighbour(name: str, importer: Source, item: Import) -> Source:
    texts = importer.neighbours or {}
    if name not in texts:
        raise _failure("G106", f"`{name}.grammar` was not kept with this file", item, did_you_mean(name, texts))
    return Source(f"{name}.grammar", texts[name], neighbours=texts)


def _neighbour(name: str, folder: Path, item: Import) -> Source:
    path = folder / f"{name}.grammar"
    if not path.is_file():
        help_ = did_you_mean(name, (other.stem for other in folder.glob("*.grammar") if other.is_file()))
        raise _failure("G106", f"there is no file `{path.name}` next to this one", item, help_)
    try:
        return read_source(path)
    except GrammarError as error:
        raise _failure("G106", error.message, item, error.hint or "") from None


def _failure(code: str, message: str, item: Import, help_: str) -> GrammarFileError:
    return GrammarFileError([Diagnostic(code, message, item.span, help_)])
