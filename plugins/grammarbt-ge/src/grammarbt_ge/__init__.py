"""Grammatical evolution."""
