from grammarbt.testing import SearcherConformance, SearcherSubject


class TestGe(SearcherConformance):
    subject = SearcherSubject("ge")
