"""A broken plugin is set aside with one line, and everything else works."""

import json
import textwrap

import pytest

HEALTHY = """
from grammarbt.plugins import SearcherSpec, hookimpl

@hookimpl
def grammarbt_searchers():
    return [SearcherSpec("NAME", "nowhere:Nothing", help="Searches nothing.")]
"""
HOOK = "from grammarbt.plugins import DomainSpec, SearcherSpec, hookimpl\n@hookimpl\n"
BREAKAGES = {
    "broken import": ("import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
    "syntax error": ("def hooks(:", "SyntaxError"),
    "exit on import": ("raise SystemExit(3)", "SystemExit: 3"),
    "deleted module": (None, "ModuleNotFoundError: No module named 'odd_hooks'"),
    "wrong interface": ("GRAMMARBT_API = 99", "written for plugin interface 99"),
    "unknown hook": (HOOK + "def grammarbt_searcher(): return []", "did you mean 'grammarbt_searchers'"),
    "unknown hook by another name": (
        HOOK.replace("hookimpl\n@hookimpl", "hookimpl\n@hookimpl(specname='grammarbt_shoes')")
        + "def shoes(): return []",
        "unknown hook 'grammarbt_shoes'",
    ),
    "hook without mark": ("def grammarbt_searchers(): return []", "lacks the @hookimpl mark"),
    "unknown argument": (HOOK + "def grammarbt_searchers(colour): return []", "colour"),
    "registration raises": (
        HOOK + "def grammarbt_domains(): raise ZeroDivisionError('oops')",
        "ZeroDivisionError: oops",
    ),
    "no sequence": (HOOK + "def grammarbt_searchers(): return SearcherSpec('a', 'b:c')", "TypeError"),
    "wrong description": (
        HOOK + "def grammarbt_domains(): return [SearcherSpec('a', 'b:c')]",
        "instead of a DomainSpec",
    ),
    "a name twice": (HOOK + "def grammarbt_searchers(): return [SearcherSpec('a', 'b:c')] * 2", "the name 'a' twice"),
    "a name of the core": (
        HOOK + "def grammarbt_searchers(): return [SearcherSpec('random', 'b:c')]",
        "searcher 'random' is also claimed by plugin 'core'",
    ),
}


def healthy(component):
    return HEALTHY.replace("NAME", component)


def listed(process):
    return {(plugin["name"], plugin["distribution"]): plugin for plugin in json.loads(process.stdout)["plugins"]}


def warnings(process):
    return [line for line in process.stderr.splitlines() if line]


@pytest.mark.parametrize("breakage", BREAKAGES)
def test_broken_plugin_is_set_aside_with_one_line_and_the_others_work(site, breakage):
    source, reason = BREAKAGES[breakage]
    site.install("odd", source, version="4.2")
    site.install("fine", healthy("hillclimb"))
    process = site.grammarbt("plugins", "--json")
    plugins = listed(process)
    assert process.returncode == 0
    assert plugins["odd", "odd"]["status"] == "set aside"
    assert plugins["odd", "odd"]["version"] == "4.2"
    assert reason in plugins["odd", "odd"]["error"]
    assert plugins["fine", "fine"]["provides"]["searchers"] == ["hillclimb"]
    assert "random" in plugins["core", "grammarbt"]["provides"]["searchers"]
    assert len(warnings(process)) == 1
    assert warnings(process)[0].startswith("warning: plugin 'odd' of odd 4.2 is set aside: ")


def test_two_distributions_with_one_plugin_name_are_both_set_aside_and_named(site):
    site.install("left", healthy("a"), entry="same")
    site.install("right", healthy("b"), entry="same")
    process = site.grammarbt("plugins", "--json")
    plugins = listed(process)
    assert "right 1.0" in plugins["same", "left"]["error"]
    assert "left 1.0" in plugins["same", "right"]["error"]
    assert len(warnings(process)) == 2


def test_two_plugins_with_one_component_name_are_both_set_aside_and_named(site):
    site.install("left", healthy("hillclimb"))
    site.install("right", healthy("hillclimb"))
    site.install("apart", healthy("other"))
    process = site.grammarbt("plugins", "--json")
    plugins = listed(process)
    assert "'hillclimb' is also claimed by plugin 'right' of right 1.0" in plugins["left", "left"]["error"]
    assert "'hillclimb' is also claimed by plugin 'left' of left 1.0" in plugins["right", "right"]["error"]
    assert plugins["apart", "apart"]["status"] == "ok"
    assert len(warnings(process)) == 2


def test_leaving_out_one_of_two_namesakes_brings_the_other_back(site):
    site.install("left", healthy("hillclimb"))
    site.install("right", healthy("hillclimb"))
    process = site.grammarbt("plugins", "--json", "--no-plugin", "left")
    plugins = listed(process)
    assert plugins["left", "left"]["status"] == "disabled"
    assert plugins["right", "right"]["provides"]["searchers"] == ["hillclimb"]
    assert warnings(process) == []


def test_unreadable_metadata_stop_nobody(site):
    info = site.install("odd", healthy("a"))
    (info / "entry_points.txt").write_text("[grammarbt]\nno equals sign here\n")
    (site.install("bare", healthy("b")) / "METADATA").unlink()
    process = site.grammarbt("plugins", "--json")
    plugins = {plugin["name"]: plugin for plugin in json.loads(process.stdout)["plugins"]}
    assert plugins["odd"]["status"] == "set aside"
    assert plugins["bare"]["provides"]["searchers"] == ["b"]
    assert len(warnings(process)) == 1


def test_a_plugin_that_prints_does_not_spoil_the_json(site):
    site.install("loud", "print('hello')\n" + healthy("a"))
    process = site.grammarbt("plugins", "--json")
    assert listed(process)["loud", "loud"]["status"] == "ok"
    assert "hello" in process.stderr


def test_disabled_plugin_is_not_even_imported(site):
    site.install("odd", "raise ValueError")
    for process in (
        site.grammarbt("--no-plugin", "odd", "plugins", "--json"),
        site.grammarbt("plugins", "--json", "--no-plugin=all"),
        site.grammarbt("plugins", "--json", GRAMMARBT_NO_PLUGINS="1"),
        site.grammarbt("plugins", "--json", GRAMMARBT_NO_PLUGINS="odd,"),
    ):
        assert listed(process)["odd", "odd"]["status"] == "disabled"
        assert warnings(process) == []


def test_strict_makes_a_broken_plugin_an_error(site):
    site.install("odd", "import no_such_module", version="4.2")
    for process in (
        site.grammarbt("plugins", "--strict-plugins"),
        site.grammarbt("plugins", GRAMMARBT_STRICT_PLUGINS="1"),
    ):
        assert process.returncode == 2
        assert process.stdout == ""
        error, hint = process.stderr.splitlines()
        assert "plugin 'odd' of odd 4.2 cannot be used" in error
        assert "--no-plugin odd" in hint


def test_help_and_version_load_no_plugin(site):
    site.install("odd", "raise ValueError")
    for option in ("--help", "--version"):
        process = site.grammarbt(option)
        assert process.returncode == 0
        assert process.stderr == ""


def test_observer_that_raises_is_switched_off_and_the_others_go_on(site):
    observer = HOOK + "def grammarbt_run_finished(event): "
    site.install("odd", observer + "raise ZeroDivisionError('oops')")
    site.install("fine", observer + "print('told', event.run, flush=True)")
    code = """
        from pathlib import Path
        from grammarbt.plugins import PluginHost, PluginOptions
        from grammarbt.plugins.events import RunFinished
        lines = []
        host = PluginHost(PluginOptions(), lines.append)
        host.notify(RunFinished(Path("here"), {}))
        host.notify(RunFinished(Path("there"), {}))
        print(lines)
    """
    process = site.python("-c", textwrap.dedent(code))
    assert process.stderr.splitlines() == ["told here", "told there"]
    assert process.stdout.count("no longer observes") == 1
    assert "plugin 'odd' of odd 1.0" in process.stdout


def test_ctrl_c_while_plugins_load_is_not_mistaken_for_a_broken_plugin(site):
    site.install("odd", "raise KeyboardInterrupt")
    process = site.grammarbt("plugins")
    assert process.returncode == 130
    assert "set aside" not in process.stderr
