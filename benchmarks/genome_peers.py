"""What mapping a genome costs alogos; run by `genomes.py` with an interpreter that has it.

The grammar is that of the artificial ant's programs without constraints, which alogos cannot state. Genomes are random;
those that cannot be finished within two wraps are left out. A codon is a choice between alternatives. Prints microseconds
of processor time per codon, and codons per genome.
"""

from __future__ import annotations

import random
import time

import alogos
from alogos.systems.ge.mapping import forward

GENOMES, LENGTH, ROUNDS = 300, 60, 5
TEXT = """
<start> ::= <either> | <both>
<program> ::= <action> | <either> | <both>
<either> ::= "?(→((food ahead) " <program> ") " <program> ")"
<both> ::= "→(" <program> <programs> ")"
<programs> ::= <program> <programs> | <program>
<action> ::= "[turn left]" | "[turn right]" | "[move forward]"
"""
SETTINGS = {"max_wraps": 2, "max_expansions": None}


def main() -> None:
    """Map the same genomes in some rounds; the best counts."""
    grammar = alogos.Grammar(bnf_text=TEXT)
    chance = random.Random(0)  # noqa: S311 - genomes need no secrecy
    genomes: list[list[int]] = []
    codons = 0
    while len(genomes) < GENOMES:
        genome = [chance.randrange(2**16) for _ in range(LENGTH)]
        try:
            _, tree = forward(grammar, genome, SETTINGS, return_derivation_tree=True)
        except alogos.exceptions.MappingError:
            continue
        genomes.append(genome)
        codons += sum(len(grammar.production_rules.get(node.symbol, ())) > 1 for node in tree.nodes())
    rounds = []
    for _ in range(ROUNDS):
        started = time.process_time()
        for genome in genomes:
            forward(grammar, genome, SETTINGS)
        rounds.append(time.process_time() - started)
    print(f"{min(rounds) / codons * 1e6:.3f} {codons / GENOMES:.1f}")


if __name__ == "__main__":
    main()
