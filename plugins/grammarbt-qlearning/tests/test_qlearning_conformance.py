from grammarbt.testing import SearcherConformance, SearcherSubject


class TestQLearning(SearcherConformance):
    subject = SearcherSubject("qlearning")
