"""Trees to compare with, put together from the sub-trees that a person would write."""

from __future__ import annotations

from grammarbt.domain import Reference

_REPORT = "→( (target found) ?( (in comms) [go to comms] ) [report] )"
_DISARM = "→( (mine found) (is armed) [disarm] )"
_RETRIEVE = "→( (object found) ?( (carrying object) [pick up] ) [take to drop off] )"
_RETRIEVE_ANY = "→( ?( (carrying object) [pick up] ) [take to drop off] )"
_APPROACH = "→( (likely target found) [go to likely target] )"
_EXPLORE = "→( [shortest path] )"
_WANDER = "→( [random walk] )"
_RECHARGE = "→( (battery low) [resurface] )"
_SWEEP = "→( [coverage] )"

REFERENCES = (
    Reference("manual", f"?( {_REPORT} {_DISARM} {_RETRIEVE} {_APPROACH} {_EXPLORE} {_WANDER} )"),
    Reference("best order", f"?( {_DISARM} {_RETRIEVE} {_APPROACH} {_REPORT} {_EXPLORE} {_WANDER} )"),
    Reference("thorough", f"?( {_RETRIEVE_ANY} {_DISARM} {_APPROACH} {_REPORT} {_EXPLORE} {_WANDER} )"),
)
"""The first in the spirit of the paper's Fig. 1, the second its sub-trees in their best order.

The third tries to pick up wherever it is, which clears the belief. It is the best where things are few, and has then seen the
whole sea without a random walk.
"""

EXTENDED_REFERENCES = (
    Reference("manual", f"?( {_RECHARGE} {_REPORT} {_DISARM} {_RETRIEVE} {_APPROACH} {_SWEEP} {_WANDER} )"),
    *REFERENCES,
)
"""Those and one that minds its battery and sweeps the area."""
