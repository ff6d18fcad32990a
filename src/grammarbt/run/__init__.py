"""Runs: a searcher wired to a domain, with a budget, a cache and a journal."""
