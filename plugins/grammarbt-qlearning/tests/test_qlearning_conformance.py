from pathlib import Path

from grammarbt.testing import SearcherConformance, SearcherSubject

WORLD = f"{Path(__file__).with_name('policy_world.py')}:PolicyLamps"
TINY = """\
%declare ACTION CONDITION
start: "?" "(" "→" "(" CONDITION ACTION ")" ACTION ")"
"""


class TestQLearning(SearcherConformance):
    subject = SearcherSubject("qlearning")


class TestPolicies(SearcherConformance):
    subject = SearcherSubject("qlearning", {"table": "policy"}, world=WORLD, tiny=TINY)
