from grammarbt.testing import SearcherConformance, SearcherSubject


class TestDagMcts(SearcherConformance):
    subject = SearcherSubject("dagmcts")


class TestPaperPreset(SearcherConformance):
    subject = SearcherSubject("dagmcts", {"preset": "paper"}, budget=100)


class TestMcdagsPreset(SearcherConformance):
    subject = SearcherSubject("dagmcts", {"preset": "mcdags", "round_length": 5, "search_rounds": 2}, budget=100)
