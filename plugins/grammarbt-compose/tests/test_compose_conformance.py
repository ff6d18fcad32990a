from grammarbt.testing import SearcherConformance, SearcherSubject


class TestCompose(SearcherConformance):
    subject = SearcherSubject("compose")
