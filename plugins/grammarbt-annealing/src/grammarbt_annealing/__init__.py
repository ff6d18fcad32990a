"""Simulated annealing over derivations."""
