"""What is put to the test: a component by the name that users type."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, cast

import numpy as np
from attrs import field, frozen

from grammarbt.bt import BehaviorTree, compile_policy, format_tree, parse
from grammarbt.domain import Domain, Outcome, Scenarios, scenario_numbers
from grammarbt.grammar import BoundGrammar, Source, bind, load_grammar
from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.testing.verdicts import NonconformityError
from grammarbt.testing.worlds import TINY, Lamps

if TYPE_CHECKING:
    from grammarbt.search import SearchContext, Searcher

SEED = 0
_SAMPLES = 6
_LONGEST_LINE = 300
_WORLD = f"{Path(__file__).with_name('worlds.py')}:{Lamps.__name__}"


def open_registry() -> Registry:
    """The installed components; a plugin that is out of use stays so without a word."""
    return Registry(PluginHost(PluginOptions.from_environment(os.environ), lambda _: None))


@frozen(slots=False)  # slots=False: cached_property keeps its value in the instance's dict
class DomainSubject:
    """A domain under test.

    Attributes:
        name: a domain's name, or `FILE.py:NAME`.
        settings: its parameters.
        episodes: scenarios that each tree is simulated on.
        seconds: how long simulating all the trees once may take.
    """

    name: str
    settings: Mapping[str, object] = field(factory=dict)
    episodes: int = 6
    seconds: float = 60.0

    @cached_property
    def registry(self) -> Registry:
        """Makes the domain."""
        return open_registry()

    def make(self) -> Domain:
        """A new instance."""
        return self.registry.make_domain(self.name, self.settings)

    @cached_property
    def domain(self) -> Domain:
        """The instance that most checks share."""
        return self.make()

    @cached_property
    def grammar(self) -> BoundGrammar:
        """The domain's default grammar."""
        return bind(load_grammar(self.registry.own_grammar(self.domain, self.name)), self.domain.vocabulary)

    @cached_property
    def trees(self) -> tuple[BehaviorTree, ...]:
        """The references, and random trees of the default grammar."""
        rng = np.random.default_rng(SEED)
        words = (self.grammar.tree(self.grammar.derive(self.grammar.sample(rng))) for _ in range(_SAMPLES))
        return tuple(dict.fromkeys([*(parse(each.tree) for each in self.domain.references), *words]))

    @property
    def scenarios(self) -> Scenarios:
        """The scenarios of most checks."""
        return scenario_numbers(SEED, 0, self.episodes)

    def simulate(self, tree: BehaviorTree, scenarios: Scenarios | None = None, domain: Domain | None = None) -> Outcome:
        """Simulate a tree, on the usual scenarios and the usual instance unless given."""
        chosen = self.domain if domain is None else domain
        policy = compile_policy(tree, chosen.vocabulary.index)
        return chosen.simulate(policy, self.scenarios if scenarios is None else scenarios)

    def elsewhere(self, trees: Sequence[BehaviorTree], hash_seed: int) -> list[list[float]]:
        """The returns of the trees in a new Python process.

        Raises:
            NonconformityError: the process failed, or took longer than `seconds`.
        """
        task = {
            "domain": self.name,
            "settings": dict(self.settings),
            "trees": [format_tree(tree) for tree in trees],
            "scenarios": [int(number) for number in self.scenarios],
        }
        answer = json.loads(python("grammarbt.testing.elsewhere", json.dumps(task), hash_seed, self.seconds))
        return cast("list[list[float]]", answer)


@frozen(slots=False)  # as above
class SearcherSubject:
    """A searcher under test.

    Attributes:
        name: a searcher's name, or `FILE.py:NAME`.
        settings: its parameters.
        budget: episodes of each trial run.
        seconds: how long one trial run may take.
        world: the domain of the trial runs, by name or as `FILE.py:NAME`, for a searcher whose trees the usual one's
            grammar does not derive. Its simulations are quick and never fail; its first reference is in its grammar.
        tiny: the text of a grammar of few words, for that domain.
    """

    name: str
    settings: Mapping[str, object] = field(factory=dict)
    budget: int = 300
    seconds: float = 60.0
    world: str = _WORLD
    tiny: str = TINY

    @cached_property
    def registry(self) -> Registry:
        """Makes the searcher, and its world."""
        return open_registry()

    @cached_property
    def domain(self) -> Domain:
        """The world of the trial runs."""
        return self.registry.make_domain(self.world, {})

    @cached_property
    def grammar(self) -> Source:
        """The world's own grammar."""
        return self.registry.own_grammar(self.domain, self.world)

    def make(self, context: SearchContext) -> Searcher:
        """A new instance."""
        return self.registry.make_searcher(self.name, context, self.settings)

    @cached_property
    def finished_run(self) -> Mapping[str, bytes]:
        """The files of a run in batches of four on one worker, by their names; what other runs are compared with."""
        with tempfile.TemporaryDirectory() as folder:
            out = self.run(Path(folder) / "run", "--batch", "4", hash_seed=1)
            return {path.name: path.read_bytes() for path in sorted(out.iterdir()) if path.is_file()}

    def run(self, out: Path, *arguments: str, hash_seed: int = 0) -> Path:
        """Run the searcher on its world in a new Python process; gives the run's folder.

        Raises:
            NonconformityError: the run failed, or took longer than `seconds`.
        """
        settings = [word for key, value in self.settings.items() for word in ("--set", f"searcher.{key}={value}")]
        common = ["--domain", self.world, "--searcher", self.name, "--budget", str(self.budget), "--validation", "2"]
        self.command_line(["run", *common, *settings, *arguments, "--out", str(out), "--json"], hash_seed)
        return out

    def command_line(self, arguments: Sequence[str], hash_seed: int = 0) -> None:
        """Call the command line in a new Python process.

        Raises:
            NonconformityError: it failed, or took longer than `seconds`.
        """
        python("grammarbt", "", hash_seed, self.seconds, arguments)


def python(module: str, text: str, hash_seed: int, seconds: float, arguments: Sequence[str] = ()) -> str:
    """What a module prints when it is run in a new Python process and reads the text.

    Raises:
        NonconformityError: it failed, or took too long.
    """
    command = [sys.executable, "-m", module, *arguments]
    environment = {**os.environ, "PYTHONHASHSEED": str(hash_seed)}
    try:
        done = subprocess.run(  # noqa: S603 - this very Python, and arguments of ours
            command, input=text, env=environment, capture_output=True, text=True, timeout=seconds, check=False
        )
    except subprocess.TimeoutExpired:
        raise NonconformityError(
            f"nothing came back within {seconds:g} s",
            "bound every episode by a number of steps, and every proposal by a number of attempts",
        ) from None
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no message"])[-2:]
        raise NonconformityError(
            f"in a new process it fails with exit code {done.returncode}: {' '.join(last)[:_LONGEST_LINE]}",
            "make it importable: no state of the parent process, no relative paths, no lambdas in parameters",
        )
    return done.stdout
