from grammarbt.testing import SearcherConformance, SearcherSubject


class TestGp(SearcherConformance):
    subject = SearcherSubject("gp")
