"""Linking: every rule that is needed gets one name in the importing file, and every directive its new names."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from functools import cached_property
from typing import TypeAlias

from attrs import evolve, field, frozen

from grammarbt.grammar.syntax import (
    Alternative,
    Argument,
    Choice,
    Declare,
    Expression,
    ForAll,
    Import,
    Item,
    Limit,
    Literal,
    Reference,
    Repeat,
    Rule,
    Unique,
    references,
)

Key: TypeAlias = tuple[str, str]
"""What tells files apart: the folder, or the empty string for shipped ones, and the name without its suffix."""


@frozen(slots=False, eq=False)  # slots=False: cached_property keeps its value in the instance's dict
class Module:
    """A file, and for each of its imported names the module and rule that are meant."""

    key: Key
    items: tuple[Item, ...]
    imported: dict[str, tuple[Module, str]] = field(factory=dict)

    @cached_property
    def rules(self) -> dict[str, list[Rule]]:
        """The rules the file itself defines, by name."""
        found: dict[str, list[Rule]] = {}
        for item in self.items:
            if isinstance(item, Rule):
                found.setdefault(item.name, []).append(item)
        return found

    @property
    def wanted(self) -> tuple[str, ...]:
        """The names under which the file imports rules, whether it gets them or not."""
        return tuple(alias for item in self.items if isinstance(item, Import) for _, alias in item.rules)

    def origin(self, name: str) -> tuple[Module, str]:
        """Where a name of this file is defined."""
        module: Module = self
        while name in module.imported:
            module, name = module.imported[name]
        return module, name


class Linker:
    """Writes all files as one: gives every rule that is needed one name in the importing file."""

    def __init__(self, main: Module, modules: dict[Key, Module]) -> None:
        self.main = main
        self.stems = _stems(modules)
        self.aliases: dict[tuple[Key, str], list[str]] = {}
        for name in main.imported:
            module, rule = main.origin(name)
            self.aliases.setdefault((module.key, rule), []).append(name)
        self.shared = {name for item in main.items if isinstance(item, ForAll) for name in item.variables}

    def items(self) -> Iterator[Item]:
        """The main file's items, the rules it needs from others, and their directives."""
        yield from (item for item in self.main.items if not isinstance(item, Import))
        needed: dict[tuple[Key, str], Module] = {}
        queue = [self.main.origin(name) for name in self.main.imported]
        while queue:
            module, name = queue.pop(0)
            if (module.key, name) in needed:
                continue
            needed[module.key, name] = module
            for rule in module.rules[name]:
                yield from self._copies(module, rule)
                queue += self._used(module, rule)
        for module in dict.fromkeys(needed.values()):
            yield from self._directives(module, needed)

    def _used(self, module: Module, rule: Rule) -> Iterator[tuple[Module, str]]:
        hidden = {*rule.parameters, *_variables(module)}
        for reference, _ in references(rule.alternatives):
            where, name = module.origin(reference.name)
            if reference.name not in hidden and name in where.rules:
                yield where, name

    def _names(self, module: Module, rule: str) -> list[str]:
        """The names a rule has in the importing file."""
        if module is self.main:
            return [rule]
        return self.aliases.get((module.key, rule)) or [f"{self.stems[module.key]}__{rule}"]

    def _copies(self, module: Module, rule: Rule) -> Iterator[Rule]:
        own = {name: self._variable(module, name) for name in _variables(module)}
        names = {name: own[name] for name in own if name not in rule.parameters}
        used = {reference.name for reference, _ in references(rule.alternatives)}
        for name in used - {*rule.parameters, *own}:
            where, origin = module.origin(name)
            if origin in where.rules:
                names[name] = self._names(where, origin)[0]
        alternatives = tuple(_alternative(alternative, names) for alternative in rule.alternatives)
        for name in self._names(module, rule.name):
            yield evolve(rule, name=name, alternatives=alternatives)

    def _variable(self, module: Module, name: str) -> str:
        return name if name in self.shared else f"{self.stems[module.key]}__{name}"

    def _directives(self, module: Module, needed: Container[tuple[Key, str]]) -> Iterator[Item]:
        """The module's directives; constraints only where their scope came along."""
        own = {name: self._variable(module, name) for name in _variables(module)}
        for item in module.items:
            if isinstance(item, Declare):
                yield item
            elif isinstance(item, ForAll):
                yield evolve(item, variables=tuple(own[name] for name in item.variables))
            elif isinstance(item, Unique | Limit):
                where, origin = module.origin(item.scope)
                if (where.key, origin) in needed:
                    yield from self._constraints(item, self._names(where, origin), own)

    def _constraints(self, item: Unique | Limit, scopes: list[str], own: dict[str, str]) -> Iterator[Item]:
        for scope in scopes:
            if isinstance(item, Limit):
                yield evolve(item, scope=scope)
            else:
                yield evolve(item, scope=scope, names=tuple(own.get(name, name) for name in item.names))


def _stems(modules: Iterable[Key]) -> dict[Key, str]:
    """A prefix for each file: its name, with a number if that is taken."""
    found: dict[Key, str] = {}
    for key in modules:
        twins = sum(other[1] == key[1] for other in found)
        found[key] = f"{key[1]}{twins + 1}" if twins else key[1]
    return found


def _variables(module: Module) -> tuple[str, ...]:
    return tuple(name for item in module.items if isinstance(item, ForAll) for name in item.variables)


def _alternative(alternative: Alternative, names: dict[str, str]) -> Alternative:
    return evolve(alternative, items=tuple(_expression(item, names) for item in alternative.items))


def _expression(item: Expression, names: dict[str, str]) -> Expression:
    if isinstance(item, Choice):
        return evolve(item, alternatives=tuple(_alternative(part, names) for part in item.alternatives))
    if isinstance(item, Repeat):
        return evolve(item, item=_expression(item.item, names))
    return _argument(item, names)


def _argument(item: Argument, names: dict[str, str]) -> Argument:
    if isinstance(item, Literal):
        return item
    arguments = tuple(_argument(part, names) for part in item.arguments)
    return Reference(names.get(item.name, item.name), arguments, item.span)
