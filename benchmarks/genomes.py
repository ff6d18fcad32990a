"""What mapping a genome to a derivation costs per codon, in grammars with constraints; beside alogos where it is given.

    python benchmarks/genomes.py [--peers PYTHON]

A codon is a choice between legal productions. Genomes are those of random derivations, mapped before, so that the tables
stand, as they do in a run after its first generations. Microseconds of processor time; the best of some rounds.
"""

from __future__ import annotations

import argparse
import subprocess
import time
from pathlib import Path

import numpy as np

from grammarbt.grammar import bind, load_grammar
from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.search import States
from grammarbt_ge.mapping import Mapper, MappingName

GENOMES, ROUNDS = 1_000, 50
DOMAINS = ("marine", "ant", "pickplace", "taskselection")
MAPPINGS: tuple[MappingName, ...] = ("linear", "structured")


def main() -> None:
    """Print a line per grammar and mapping."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peers", metavar="PYTHON", help="an interpreter that has alogos")
    peers = parser.parse_args().peers
    print("grammar                   mapping      us per codon  codons per genome")
    registry = Registry(PluginHost(PluginOptions(), print))
    for name in DOMAINS:
        domain = registry.make_domain(name, {})
        states = States(bind(load_grammar(registry.find_grammar(domain.grammar)), domain.vocabulary))
        for mapping in MAPPINGS:
            print_row(name, mapping, *measured(Mapper(states, mapping, wraps=2)))
    if peers:
        command = [peers, str(Path(__file__).with_name("genome_peers.py"))]
        found = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
        print_row("ant, no constraints", "alogos", *map(float, found))


def measured(mapper: Mapper) -> tuple[float, float]:
    """Microseconds per codon, and codons per genome."""
    rng = np.random.default_rng(0)
    genomes = [mapper.genome(mapper.states.grammar.sample(rng), rng) for _ in range(GENOMES)]
    codons = sum(len(codons) for genome in genomes for codons in genome)
    rounds = []
    for _ in range(ROUNDS):
        started = time.process_time()
        for genome in genomes:
            mapper.derivation(genome)
        rounds.append(time.process_time() - started)
    return min(rounds) / codons * 1e6, codons / GENOMES


def print_row(grammar: str, mapping: str, cost: float, codons: float) -> None:
    """One line of the table."""
    print(f"{grammar:25} {mapping:12} {cost:12.3f}  {codons:17.1f}", flush=True)


if __name__ == "__main__":
    main()
