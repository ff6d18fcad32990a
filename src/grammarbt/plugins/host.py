"""The host: loads plugins, each behind a guard, and alone talks to pluggy.

One broken plugin never stops the others: it is set aside with its distribution, version and reason. Nothing depends on
the order in which plugins are found.
"""

from __future__ import annotations

import contextlib
import inspect
import sys
from collections import defaultdict
from functools import partial
from typing import TYPE_CHECKING, TypeAlias, TypeVar

import pluggy
from attrs import evolve, frozen

from grammarbt import __version__
from grammarbt.errors import PluginError, UnknownNameError, did_you_mean
from grammarbt.plugins import builtin, hookspecs
from grammarbt.plugins.discovery import Announcement, announcements
from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished
from grammarbt.plugins.plugin import CORE, SPEC_TYPES, Components, Plugin, Spec, without_clashes
from grammarbt.plugins.specs import GRAMMARBT_API

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

Event: TypeAlias = RunStarted | TrialFinished | RunFinished
Answer = TypeVar("Answer")

_OBSERVERS: Mapping[type[Event], str] = {
    RunStarted: "grammarbt_run_started",
    TrialFinished: "grammarbt_trial_finished",
    RunFinished: "grammarbt_run_finished",
}


@frozen
class PluginOptions:
    """What the user wants of the plugins.

    Attributes:
        disabled: names of plugins not to load; `"all"` or `"1"` stands for every one.
        strict: whether a plugin that would be set aside is an error instead.
    """

    disabled: tuple[str, ...] = ()
    strict: bool = False

    @classmethod
    def from_environment(cls, environment: Mapping[str, str]) -> PluginOptions:
        """Read `GRAMMARBT_NO_PLUGINS` (`1`, `all` or names with commas) and `GRAMMARBT_STRICT_PLUGINS`."""
        names = (name.strip() for name in environment.get("GRAMMARBT_NO_PLUGINS", "").split(","))
        strict = environment.get("GRAMMARBT_STRICT_PLUGINS", "")
        return cls(tuple(name for name in names if name not in {"", "0"}), strict not in {"", "0"})

    @property
    def disables_all(self) -> bool:
        """Whether no plugin at all is to be loaded."""
        return not {"all", "1"}.isdisjoint(self.disabled)


class PluginHost:
    """Every plugin, loaded once.

    Args:
        options: which plugins to leave out, and whether to be strict.
        warn: told one line for each plugin that is set aside.

    Attributes:
        options: as given.
        plugins: the core first, then all others by name, whatever their status.

    Raises:
        PluginError: a plugin cannot be used, and `options.strict` is on.
        UnknownNameError: `options.disabled` names a plugin that is not installed.
    """

    def __init__(self, options: PluginOptions, warn: Callable[[str], None]) -> None:
        self.options = options
        self._warn = warn
        self._hooks: dict[str, pluggy.HookRelay] = {}
        self.plugins = without_clashes([self._core(), *self._announced()])
        self._observers = {event: self._listening(hook) for event, hook in _OBSERVERS.items()}
        self._report_broken()

    def notify(self, event: Event) -> None:
        """Tell every observer; one that raises is switched off from then on, with one line."""
        for plugin in tuple(self._observers[type(event)]):
            try:
                hook: pluggy.HookCaller = getattr(self._hooks[plugin.name], _OBSERVERS[type(event)])
                _guarded(hook.name, partial(hook, event=event))
            except PluginError as error:
                for observers in self._observers.values():
                    if plugin in observers:
                        observers.remove(plugin)
                self._warn(f"{plugin} no longer observes: {error.message}")

    def _listening(self, hook: str) -> list[Plugin]:
        used = (plugin for plugin in self.plugins if plugin.status == "ok")
        return [plugin for plugin in used if getattr(self._hooks[plugin.name], hook).get_hookimpls()]

    def _core(self) -> Plugin:
        return self._registered(Plugin(CORE, "grammarbt", __version__), builtin)

    def _announced(self) -> list[Plugin]:
        by_name: dict[str, list[Announcement]] = defaultdict(list)
        for announcement in announcements():
            by_name[announcement.name].append(announcement)
        if not self.options.disables_all:
            for name in self.options.disabled:
                if name not in by_name:
                    raise UnknownNameError("plugin", name, by_name)
        return [self._loaded(announcement, namesakes) for namesakes in by_name.values() for announcement in namesakes]

    def _loaded(self, announcement: Announcement, namesakes: Sequence[Announcement]) -> Plugin:
        plugin = Plugin(announcement.name, announcement.distribution, announcement.version)
        if self.options.disables_all or plugin.name in self.options.disabled:
            return evolve(plugin, status="disabled")
        try:
            _check_unique(announcement, namesakes)
            return self._registered(plugin, _guarded("importing it", announcement.load))
        except PluginError as error:
            return plugin.set_aside(error.message)

    def _registered(self, plugin: Plugin, module: object) -> Plugin:
        version = getattr(module, "GRAMMARBT_API", GRAMMARBT_API)
        if version != GRAMMARBT_API:
            raise PluginError(f"written for plugin interface {version!r}; this grammarbt has {GRAMMARBT_API}")
        hooks = self._hooks[plugin.name] = _guarded("registering it", lambda: _hook_relay(module))
        return evolve(plugin, provides=_components(hooks))

    def _report_broken(self) -> None:
        broken = [plugin for plugin in self.plugins if plugin.status == "set aside"]
        if broken and self.options.strict:
            reasons = "; ".join(f"{plugin} cannot be used: {plugin.error}" for plugin in broken)
            raise PluginError(reasons, f"repair or uninstall it, or leave it out with --no-plugin {broken[0].name}")
        for plugin in broken:
            self._warn(f"{plugin} is set aside: {plugin.error}")


def _check_unique(announcement: Announcement, namesakes: Sequence[Announcement]) -> None:
    if announcement.name == CORE:
        raise PluginError(f"the name {CORE!r} is taken by grammarbt itself")
    others = [f"{other.distribution} {other.version}" for other in namesakes if other is not announcement]
    if others:
        raise PluginError(f"its name is also claimed by {' and '.join(others)}")


def _hook_relay(module: object) -> pluggy.HookRelay:
    # One manager per plugin: a hook of one may then fail without keeping pluggy from calling the others.
    manager = pluggy.PluginManager("grammarbt")
    manager.add_hookspecs(hookspecs)
    _check_hook_names(module)
    manager.register(module)
    manager.check_pending()
    return manager.hook


def _check_hook_names(module: object) -> None:
    known = [name for name in vars(hookspecs) if name.startswith("grammarbt_")]
    for name, function in inspect.getmembers(module, inspect.isfunction):
        if name.startswith("grammarbt_"):
            if name not in known:
                raise PluginError(f"unknown hook {name!r}, {did_you_mean(name, known)}")
            if not hasattr(function, "grammarbt_impl"):
                raise PluginError(f"{name!r} lacks the @hookimpl mark")


def _components(hooks: pluggy.HookRelay) -> Components:
    return {kind: _specs(getattr(hooks, f"grammarbt_{kind}"), kind) for kind in SPEC_TYPES}


def _specs(hook: pluggy.HookCaller, kind: str) -> tuple[Spec, ...]:
    specs = _guarded(hook.name, lambda: tuple(spec for answer in hook() for spec in answer))
    wrong = [spec for spec in specs if not isinstance(spec, SPEC_TYPES[kind])]
    if wrong:
        raise PluginError(f"{hook.name} gave {wrong[0]!r} instead of a {SPEC_TYPES[kind].__name__}")
    names = [spec.name for spec in specs]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise PluginError(f"{hook.name} gave the name {twice[0]!r} twice")
    return specs


def _guarded(what: str, call: Callable[[], Answer]) -> Answer:
    """The border to a stranger's code: whatever goes wrong there becomes a `PluginError`.

    Standard output belongs to the command's result, so what a plugin prints goes to standard error.
    """
    try:
        with contextlib.redirect_stdout(sys.stderr):
            return call()
    except PluginError:
        raise
    except (Exception, SystemExit) as error:
        raise PluginError(f"{what} raised {type(error).__name__}: {error}") from error
