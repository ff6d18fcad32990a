"""The grammar language: reading `.grammar` files, binding them to a vocabulary, deriving trees."""

from grammarbt.grammar.bind import bind
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Source, Span
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.imports import read_source
from grammarbt.grammar.leftmost import Word
from grammarbt.grammar.model import Grammar, load_grammar, read_grammar
from grammarbt.grammar.shipped import shipped_grammars
from grammarbt.grammar.table import Derivation, Production

__all__ = [
    "BoundGrammar",
    "Derivation",
    "Diagnostic",
    "Grammar",
    "GrammarFileError",
    "Production",
    "SententialForm",
    "Source",
    "Span",
    "Word",
    "bind",
    "load_grammar",
    "read_grammar",
    "read_source",
    "shipped_grammars",
]
