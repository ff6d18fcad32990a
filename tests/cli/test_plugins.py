"""The command line's frame, and `grammarbt plugins`."""

import json
import os
import subprocess
import sys

import pytest

from grammarbt import __version__
from grammarbt.cli import main
from grammarbt.cli.app import VERBS

HEAVY = ("numpy", "numba", "lark", "networkx", "rich", "grammarbt.search", "grammarbt_dagmcts.search")


def fresh(code):
    """What the code prints in a fresh interpreter, on both streams, and its exit code."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["plugins"], ["plugins", "--json"]])
def test_help_and_listing_import_nothing_heavy(arguments):
    code = f"import sys; from grammarbt.cli import main; main({arguments}); print(*sys.modules, file=sys.stderr)"
    process = fresh(code)
    assert "grammarbt.cli.app" in process.stderr.split()
    assert not set(HEAVY) & set(process.stderr.split())


def test_help_costs_less_than_a_third_of_a_second_of_cpu():
    code = "import time; from grammarbt.cli import main; main(['--help']); print('CPU', time.process_time())"
    assert float(fresh(code).stdout.split()[-1]) < 0.3


def test_help_names_every_verb(capsys):
    assert main(["--help"]) == 0
    help_page = capsys.readouterr().out
    assert all(f"\n  {verb} " in help_page for verb in VERBS)


def test_no_argument_shows_the_help(capsys):
    assert main([]) == 0
    assert capsys.readouterr().out.startswith("Usage: grammarbt")


def test_version_is_the_distributions(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"grammarbt {__version__}\n"


@pytest.mark.parametrize(
    ("arguments", "error", "hint"),
    [
        (["plgins"], "unknown command 'plgins'", "did you mean 'plugins'?"),
        (["plugins", "--jsn"], "no such option '--jsn'", "did you mean '--json'?"),
        (["plugins", "a", "b"], "got unexpected extra argument (b)", "see 'grammarbt plugins --help'"),
        (["plugins", "--no-plugin"], "option '--no-plugin' needs the name of a plugin", "see 'grammarbt --help'"),
        (["plugins", "randm"], "unknown plugin or component 'randm'", "did you mean 'random'?"),
    ],
)
def test_mistake_gives_a_line_and_a_hint_and_exit_2(capsys, arguments, error, hint):
    assert main(arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err == f"error: {error}\nhint: {hint}\n"


def test_unknown_plugin_to_leave_out_is_a_mistake(capsys):
    assert main(["plugins", "--no-plugin", "nonesuch"]) == 2
    assert capsys.readouterr().err.startswith("error: unknown plugin 'nonesuch'\n")


def test_traceback_is_shown_when_asked_for(capsys):
    assert main(["plugins", "randm", "--traceback"]) == 2
    assert "Traceback (most recent call last)" in capsys.readouterr().err


def test_bug_is_one_line_and_exit_1(capsys, monkeypatch):
    monkeypatch.setitem(VERBS, "plugins", ("grammarbt.cli.nowhere:command", ""))
    assert main(["plugins"]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("internal error: ModuleNotFoundError")


def test_reader_who_stops_reading_is_no_error():
    code = "from grammarbt.cli import main; raise SystemExit(main(['plugins', 'core']))"
    read, write = os.pipe()
    os.close(read)
    process = subprocess.run([sys.executable, "-c", code], stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert process.stderr == ""


def test_full_disk_is_one_line():
    code = "from grammarbt.cli import main; raise SystemExit(main(['plugins']))"
    with open("/dev/full", "w") as full:  # noqa: PTH123
        process = subprocess.run(
            [sys.executable, "-c", code], stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )
    assert (process.returncode, process.stderr) == (2, "error: output: No space left on device\n")


def test_json_lists_the_core_like_a_plugin(capsys):
    assert main(["plugins", "--json", "--no-plugin", "all"]) == 0
    listing = json.loads(capsys.readouterr().out)
    core = listing["plugins"][0]
    assert set(core) == {"name", "distribution", "version", "status", "error", "provides"}
    assert (core["name"], core["status"], core["error"]) == ("core", "ok", None)
    assert "random" in core["provides"]["searchers"]


def test_every_announced_component_shows_its_parameters(capsys):
    assert main(["plugins", "--json"]) == 0
    for plugin in json.loads(capsys.readouterr().out)["plugins"]:
        assert main(["plugins", plugin["name"], "--json"]) == 0
        shown = json.loads(capsys.readouterr().out)["components"]
        assert sorted(c["name"] for c in shown) == sorted(n for names in plugin["provides"].values() for n in names)
        for component in shown:
            assert all(parameter["help"] for parameter in component["parameters"])


def test_table_shows_what_json_holds(capsys):
    assert main(["plugins", "--no-plugin", "all"]) == 0
    table = capsys.readouterr().out.splitlines()
    assert table[0].split() == ["NAME", "DISTRIBUTION", "VERSION", "STATUS", "PROVIDES"]
    assert table[1].startswith("core  ")
