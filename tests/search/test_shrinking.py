"""Shorter neighbours."""

import numpy as np

from grammarbt.bt import format_tree
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Edits

GROUPS = '%declare ACTION CONDITION\n%limit nodes 9\nstart: "?" "(" part+ ")"\npart: ACTION | "→" "(" part part+ ")"\n'


def test_shorter_derivations_lack_something_and_are_of_the_language(vocabulary):
    edits, rng = Edits(bind(load_grammar(Source("groups.grammar", GROUPS)), vocabulary)), np.random.default_rng(1)
    site = max((edits.site(edits.sample(rng)) for _ in range(100)), key=lambda site: len(site.tree.steps))
    found = edits.shrinking.shorter(site, rng)
    assert len(found) > len(site.rows)
    for derivation in found:
        tree = edits.grammar.tree(edits.grammar.derive(derivation))
        assert len(format_tree(tree)) < len(format_tree(edits.states.tree(site.tree.steps)))
