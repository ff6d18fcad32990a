"""grammarbt: learn behavior trees from a grammar."""

__version__ = "0.1.0"
