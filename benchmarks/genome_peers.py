"""What mapping a genome costs other libraries; run by `genomes.py` with an interpreter that has them.

The grammar is that of the artificial ant's programs, without constraints, which these libraries cannot state. Genomes are
random; those that alogos cannot finish within two wraps, or Genetic Engine within its depth, are left out. Prints
lines of: name, codons per genome, microseconds per codon.
"""

from __future__ import annotations

import random
import time
from abc import ABC
from collections.abc import Callable
from dataclasses import dataclass

GENOMES, LENGTH, ROUNDS = 300, 60, 5
TEXT = """
<start> ::= <either> | <both>
<program> ::= <action> | <action> | <either> | <both>
<either> ::= "?(→((food ahead) " <program> ") " <program> ")"
<both> ::= "→(" <program> <programs> ")"
<programs> ::= <program> <programs> | <program>
<action> ::= "[turn left]" | "[turn right]" | "[move forward]"
"""


def main() -> None:
    """Measure each library that is installed."""
    for measure in (alogos, genetic_engine):
        try:
            measure()
        except ImportError as error:
            print(f"# {measure.__name__}: {error}")


def report(name: str, codons: int, genomes: int, work: Callable[[], object]) -> None:
    """The best of some rounds."""
    rounds = []
    for _ in range(ROUNDS):
        started = time.process_time()
        work()
        rounds.append(time.process_time() - started)
    print(f"{name}\t{codons / genomes:.1f}\t{min(rounds) / codons * 1e6:.3f}")


def alogos() -> None:
    """Codons are counted in the derivation tree: one per nonterminal with several alternatives."""
    import alogos as library  # noqa: PLC0415 - each library may be missing
    from alogos.systems.ge.mapping import forward  # noqa: PLC0415 - as above

    grammar = library.Grammar(bnf_text=TEXT)
    chance = random.Random(0)  # noqa: S311 - genomes need no secrecy
    settings = {"max_wraps": 2, "max_expansions": None}
    finished, codons = [], 0
    while len(finished) < GENOMES:
        genome = [chance.randrange(2**16) for _ in range(LENGTH)]
        try:
            _, tree = forward(grammar, genome, settings, return_derivation_tree=True)
        except library.exceptions.MappingError:
            continue
        finished.append(genome)
        codons += sum(len(grammar.production_rules.get(node.symbol, ())) > 1 for node in tree.nodes())
    report("alogos", codons, GENOMES, lambda: [forward(grammar, genome, settings) for genome in finished])


class Program(ABC):
    """What an ant may do."""


@dataclass
class Act(Program):
    """One of three actions."""

    name: int


@dataclass
class Either(Program):
    """The first if there is food ahead, else the second."""

    one: Program
    other: Program


@dataclass
class Both(Program):
    """One after the other."""

    one: Program
    other: Program


def genetic_engine() -> None:
    """Codons are counted as the mapping reads them."""
    from geneticengine.grammar.grammar import extract_grammar  # noqa: PLC0415 - each library may be missing
    from geneticengine.random.sources import NativeRandomSource  # noqa: PLC0415 - as above
    from geneticengine.representations.grammatical_evolution import ge  # noqa: PLC0415 - as above
    from geneticengine.representations.tree.initializations import MaxDepthDecider  # noqa: PLC0415 - as above

    grammar = extract_grammar([Act, Either, Both], Program)
    source = NativeRandomSource(0)
    representation = ge.GrammaticalEvolutionRepresentation(grammar, MaxDepthDecider(source, grammar, 6), LENGTH)
    genomes = [representation.create_genotype(source) for _ in range(GENOMES)]
    read = 0
    plain = ge.ListWrapper.randint

    def counted(own: object, low: int, high: int) -> int:
        nonlocal read
        read += 1
        return int(plain(own, low, high))

    ge.ListWrapper.randint = counted
    for genome in genomes:
        representation.genotype_to_phenotype(genome)
    ge.ListWrapper.randint = plain
    report(
        "Genetic Engine", read, GENOMES, lambda: [representation.genotype_to_phenotype(genome) for genome in genomes]
    )


if __name__ == "__main__":
    main()
