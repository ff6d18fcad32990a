"""Toy worlds for grammarbt: domains small enough to see whether a searcher works."""
