from grammarbt.testing import SearcherConformance, SearcherSubject


class TestAnnealing(SearcherConformance):
    subject = SearcherSubject("annealing")
