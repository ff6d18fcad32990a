"""The list of benchmarks is complete, and what it names can be started."""

import re
from pathlib import Path

import pytest

from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.run.bench import cells, read_bench

ROOT = Path(__file__).parents[2]
BENCHMARKS = ROOT / "benchmarks"
PAGE = (BENCHMARKS / "README.md").read_text(encoding="utf-8")
SPECS = sorted(BENCHMARKS.glob("*.toml"))


def test_every_file_is_named():
    named = set(re.findall(r"([\w]+\.(?:py|toml))", PAGE))
    assert sorted(named) == sorted(path.name for path in BENCHMARKS.iterdir() if path.suffix in {".py", ".toml"})


def test_commands_are_those_that_start():
    listed = set(re.findall(r"^\| `python benchmarks/(\w+\.py)", PAGE, re.MULTILINE))
    starting = {path.name for path in BENCHMARKS.glob("*.py") if "__main__" in path.read_text(encoding="utf-8")}
    assert sorted(listed) == sorted(starting - {"genome_peers.py"})


def test_options_on_the_page_exist():
    for name, options in re.findall(r"`python benchmarks/(\w+\.py)([^`]*)`", PAGE):
        text = (BENCHMARKS / name).read_text(encoding="utf-8")
        assert [option for option in re.findall(r"--[a-z]+", options) if f'"{option}"' not in text] == []


def test_benchmarks_that_other_pages_name_exist():
    pages = [ROOT / "README.md", *(path for path in (ROOT / "docs").rglob("*.md") if "_build" not in path.parts)]
    text = "".join(page.read_text(encoding="utf-8") for page in pages)
    named = set(re.findall(r"benchmarks/(\w+\.(?:py|toml))", text))
    assert named
    assert [name for name in sorted(named) if not (BENCHMARKS / name).exists()] == []


@pytest.mark.parametrize("spec", SPECS, ids=lambda path: path.name)
def test_specs_name_what_there_is(spec):
    bench = read_bench(spec)
    registry = Registry(PluginHost(PluginOptions(), lambda _: None))
    for domain in bench.domain:
        assert registry.domain(domain.name)
    for searcher in bench.searcher:
        assert registry.searcher(searcher.name)
    assert len({cell.folder.path for cell in cells(bench)}) == len(cells(bench))
    assert min(bench.run_seeds) >= 100
