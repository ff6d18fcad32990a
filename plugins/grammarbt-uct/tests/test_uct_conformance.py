from grammarbt.testing import SearcherConformance, SearcherSubject


class TestUct(SearcherConformance):
    subject = SearcherSubject("uct")
