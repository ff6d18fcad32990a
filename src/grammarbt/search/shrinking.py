"""Shorter derivations: all that lack a little of one."""

from __future__ import annotations

import numpy as np

from grammarbt.grammar import Derivation
from grammarbt.search.derivations import Template
from grammarbt.search.rowedits import RowEdits
from grammarbt.search.short import ShortFirst
from grammarbt.search.site import Site, Sites


class Shrinking:
    """Takes parts of derivations away.

    Args:
        sites: of the grammar.
        rows: edits of its rows.
        short: says what is in the language.
    """

    def __init__(self, sites: Sites, rows: RowEdits, short: ShortFirst) -> None:
        self.sites, self.rows, self.short = sites, rows, short

    def shorter(self, site: Site, rng: np.random.Generator) -> list[Derivation]:
        """Every derivation with an item less, or with an item's inner row in its place."""
        found: dict[Derivation, None] = {}
        for row in site.rows:
            for at in range(len(row.items)):
                inner = [other.items for other in site.rows if row.holds(at, other.node)]
                for items in ((), *inner):
                    kept = [item for item in items if self.sites.rows.admits(row.symbol, item)]
                    derivation = self._completed(self.rows.spliced(site, row, (at, at + 1), kept), rng)
                    if derivation is not None and derivation != site.tree.steps:
                        found[derivation] = None
        return list(found)

    def _completed(self, template: Template | None, rng: np.random.Generator) -> Derivation | None:
        return self.short.complete(template, rng) if template else None
