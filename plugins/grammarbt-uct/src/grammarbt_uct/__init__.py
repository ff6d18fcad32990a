"""UCT over leftmost derivations."""
