"""The kit's lamps, with a grammar that derives policies."""

from grammarbt.testing.worlds import Lamps


class PolicyLamps(Lamps):
    """Lights by rules, the last of which may be without conditions."""

    grammar = """\
%declare ACTION CONDITION
start: "?" "(" rule+ ACTION? ")"
rule: "→" "(" check+ ACTION ")"
check: CONDITION | "!" "(" CONDITION ")"
"""
