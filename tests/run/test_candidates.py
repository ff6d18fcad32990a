"""What the final selection chooses among."""

import pytest

from grammarbt.bt import parse
from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.run.execute import execute
from grammarbt.run.setup import prepare
from grammarbt.run.spec import RunSpec
from grammarbt.run.watch import Watcher

DOMAIN = "docs/examples/corridor.py:Corridor"
FORGETFUL = """
from grammarbt.search.random import RandomSearch

class Forgetful(RandomSearch):
    def candidates(self, n):
        return {candidates}
"""


@pytest.fixture
def chosen(tmp_path):
    """The tree that a run ends with when its searcher believes in others, and the best one of its search."""

    def run(candidates):
        code = tmp_path / "forgetful.py"
        code.write_text(FORGETFUL.format(candidates=candidates), encoding="utf-8")
        spec = RunSpec(domain=DOMAIN, searcher=f"{code}:Forgetful", budget=200, validation=2, out=str(tmp_path / "run"))
        setup = prepare(spec, Registry(PluginHost(PluginOptions(), print)))
        best = []

        class Watching(Watcher):
            def notify(self, event):
                best.append(getattr(event, "best_tree", best[-1] if best else ""))

        return execute(setup, Watching()).tree, best[-1]

    return run


@pytest.mark.parametrize("candidates", ["[]", "self._ranked()[-1:][0][:1]"])
def test_the_best_tree_of_the_search_is_a_candidate_even_if_its_searcher_forgot_it(chosen, candidates):
    tree, best = chosen(candidates)
    assert parse(tree) == parse(best)
