from grammarbt.testing import SearcherConformance, SearcherSubject


class TestDagMcts(SearcherConformance):
    subject = SearcherSubject("dagmcts")


class TestPaperPreset(SearcherConformance):
    subject = SearcherSubject("dagmcts", {"preset": "paper"}, budget=100)
