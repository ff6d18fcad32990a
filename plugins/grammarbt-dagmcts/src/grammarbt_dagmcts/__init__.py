"""Monte Carlo search over the derivation DAG of a grammar."""
