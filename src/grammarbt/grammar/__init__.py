"""The grammar language: reading `.grammar` files, binding them to a vocabulary, deriving trees."""

from grammarbt.grammar.automaton import Language
from grammarbt.grammar.bind import bind
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.count import Count, Counter
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Source, Span
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.imports import bundled, read_source
from grammarbt.grammar.independence import is_independent
from grammarbt.grammar.leftmost import Word
from grammarbt.grammar.model import Grammar, load_grammar, read_grammar
from grammarbt.grammar.parse import NotInLanguageError, parse_tree
from grammarbt.grammar.paths import InfiniteLanguageError, TooLargeError
from grammarbt.grammar.pieces import Piece, Pieces
from grammarbt.grammar.shipped import shipped_grammars
from grammarbt.grammar.spelling import Spelling
from grammarbt.grammar.table import Derivation, Production
from grammarbt.grammar.uniform import Likely, Uniform, sampler

__all__ = [
    "BoundGrammar",
    "Count",
    "Counter",
    "Derivation",
    "Diagnostic",
    "Grammar",
    "GrammarFileError",
    "InfiniteLanguageError",
    "Language",
    "Likely",
    "NotInLanguageError",
    "Piece",
    "Pieces",
    "Production",
    "SententialForm",
    "Source",
    "Span",
    "Spelling",
    "TooLargeError",
    "Uniform",
    "Word",
    "bind",
    "bundled",
    "is_independent",
    "load_grammar",
    "parse_tree",
    "read_grammar",
    "read_source",
    "sampler",
    "shipped_grammars",
]
