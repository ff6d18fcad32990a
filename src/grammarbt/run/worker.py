"""What happens in a worker process: the domain is made once, then trees come as text and returns go back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grammarbt.bt import parse
from grammarbt.plugins import PluginHost, Registry
from grammarbt.run.simulate import Simulation, simulate_tree

if TYPE_CHECKING:
    from collections.abc import Mapping

    from grammarbt.domain import Domain, Scenarios
    from grammarbt.plugins import PluginOptions

_domain: Domain
"""This process's own; there is one, so that a call need not carry it."""


def start_worker(name: str, settings: Mapping[str, object], options: PluginOptions) -> None:
    """Make the domain and, if its simulator is compiled when first called, compile it; no episode is simulated."""
    global _domain  # noqa: PLW0603 - a process has no better place for what outlives a call
    _domain = Registry(PluginHost(options, lambda _: None)).make_domain(name, settings)
    for reference in _domain.references[:1]:
        simulate_tree(_domain, parse(reference.tree), np.array([], dtype=np.int64))


def simulate_text(tree: str, scenarios: Scenarios) -> Simulation:
    """Simulate one episode per scenario."""
    return simulate_tree(_domain, parse(tree), scenarios)
