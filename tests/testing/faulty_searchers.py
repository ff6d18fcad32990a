"""Searchers with one fault each; every class says in `caught_by` which check must find it."""

import os
import random
import sys
from pathlib import Path
from statistics import stdev

from attrs import evolve

from grammarbt.bt import Fallback
from grammarbt.search.random import RandomSearch


class OutsideTheLanguage(RandomSearch):
    caught_by = "proposals are words of the language"

    def ask(self, n):
        return [evolve(each, tree=Fallback((each.tree, each.tree)), derivation=None) for each in super().ask(n)]


class WrongDerivation(RandomSearch):
    caught_by = "proposals are words of the language"
    last = None

    def ask(self, n):
        proposals = super().ask(n)
        before, self.last = self.last, proposals[-1].derivation
        return [evolve(each, derivation=before or each.derivation) for each in proposals]


class TooMany(RandomSearch):
    caught_by = "asks for no more than wanted"

    def ask(self, n):
        return super().ask(n + 1)


class NoScenarios(RandomSearch):
    caught_by = "asks for no more than wanted"

    def ask(self, n):
        return [evolve(each, stop=each.start) for each in super().ask(n)]


class BelievesInNothing(RandomSearch):
    caught_by = "candidates are trees it believes in"

    def candidates(self, n):
        return []


class EndlessMetric(RandomSearch):
    caught_by = "candidates are trees it believes in"

    def metrics(self):
        return {"rate": float("inf")}


class IgnoresTheStart(RandomSearch):
    caught_by = "begins from the start tree"

    def __init__(self, context, parameters):
        super().__init__(evolve(context, start=None), parameters)


class GivesUpAfterFailure(RandomSearch):
    caught_by = "copes with failed evaluations"
    broken = False

    def ask(self, n):
        return [] if self.broken else super().ask(n)

    def tell(self, evaluations):
        self.broken = self.broken or any(each.status != "ok" for each in evaluations)
        super().tell(evaluations)


class DividesBySpread(RandomSearch):
    caught_by = "copes with constant returns"

    def __init__(self, context, parameters):
        super().__init__(context, parameters)
        self.seen = []

    def tell(self, evaluations):
        self.seen += [each.mean for each in evaluations if each.returns]
        if len(self.seen) > 10:
            self.scale = 1 / stdev(self.seen)
        super().tell(evaluations)


class ListsEverything(RandomSearch):
    caught_by = "copes with an infinite language"

    def __init__(self, context, parameters):
        super().__init__(context, parameters)
        if not context.grammar.is_finite():
            raise ValueError("the language cannot be listed")


class Stalls(RandomSearch):
    """Waits for a tenth word in a language of nine."""

    caught_by = "comes to an end"

    def __init__(self, context, parameters):
        super().__init__(context, parameters)
        self.met = set()

    def ask(self, n):
        for _ in range(300_000):
            proposal = super().ask(1)[0]
            if proposal.tree not in self.met:
                self.met.add(proposal.tree)
                return [proposal]
        raise TimeoutError


class OrderOfASet(RandomSearch):
    caught_by = "same seed same run"

    def ask(self, n):
        return sorted(super().ask(3), key=lambda proposal: hash(str(proposal)))[:1]


class OrderOfArrival(RandomSearch):
    """Looks at how many workers its run has, as one that listens to the clock would."""

    caught_by = "worker count does not matter"

    def ask(self, n):
        return super().ask(1 if "--workers" in sys.argv and sys.argv[sys.argv.index("--workers") + 1] == "2" else n)


class NotesOnDisk(RandomSearch):
    caught_by = "replay equals one go"

    def tell(self, evaluations):
        notes = Path(os.environ["GRAMMARBT_NOTES"]) / "told"
        self.noted = len(evaluations) + (int(notes.read_text()) if notes.exists() else 0)
        notes.write_text(str(self.noted))
        super().tell(evaluations)

    def ask(self, n):
        asked = super().ask(n)
        return [evolve(each, start=each.start + (getattr(self, "noted", 0) > 400)) for each in asked]


class SharedRandomness(RandomSearch):
    caught_by = "global randomness is untouched"

    def ask(self, n):
        random.shuffle([1, 2, 3])
        return super().ask(n)
