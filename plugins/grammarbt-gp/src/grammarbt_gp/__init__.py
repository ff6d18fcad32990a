"""Grammar-guided genetic programming."""
