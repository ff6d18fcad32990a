"""Trees on a page: drawn as in the paper, node by node, and from one best tree to the next."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from grammarbt.bt import Action, BehaviorTree, Condition, children, format_leaf, format_tree, numbered, parse
from grammarbt.bt.formats import svg
from grammarbt.bt.layout import lay_out
from grammarbt.bt.notation import operator
from grammarbt.report.markup import Content, Markup, details, element, joined, scrolling, table
from grammarbt.report.thinning import thinned

if TYPE_CHECKING:
    from grammarbt.report.history import Improvement
    from grammarbt.run.inspection import Change, Inspection, NodeCount

_MOST_CHANGES = 40
_PERCENT = 100
_SMALLEST = 0.7
"""What wide drawings shrink to at most, so that they stay readable; wider ones scroll."""


def drawn(caption: str, notation: str) -> Markup:
    """A tree with its caption, and the notation to copy."""
    tree = parse(notation)
    look = f'<svg role="img" style="min-width:{_SMALLEST * lay_out(tree).width:.0f}px" '
    picture = Markup(svg.dumps(tree).replace("<svg ", look, 1))
    text = details("In one line", element("pre", element("code", notation), tabindex="0"))
    return element("figure", element("figcaption", caption), scrolling(caption, picture), text, class_="tree")


def changes(improvements: Sequence[Improvement]) -> Markup:
    """A row for each new best tree: what came and what went; thinned out when they are many."""
    shown = thinned(improvements, _MOST_CHANGES)
    before: list[Counter[str]] = [Counter(), *(_parts(each.tree) for each in shown)]
    rows = [
        (f"{each.episodes:,}", f"{each.trial:,}", f"{each.mean:.5g}", _difference(old, _parts(each.tree)))
        for each, old in zip(shown, before, strict=False)
    ]
    many = f", {len(shown)} of {len(improvements):,}" if len(shown) < len(improvements) else ""
    return table(f"New best trees{many}", ("Episodes", "Trial", "Mean in the search", "Sub-trees that changed"), rows)


def contributions(found: Sequence[Change]) -> Markup:
    """What the mean return becomes without each sub-tree, with a bar."""
    most = max((abs(each.change) for each in found), default=0.0) or 1.0
    rows = [
        (each.subtree, f"{each.change:+.4g}", f"{each.low:+.4g} to {each.high:+.4g}", _bar(each.change / most))
        for each in found
    ]
    return table("The mean return without it", ("Sub-tree", "Change", "95 % interval", "Bar"), rows)


def visits(tree: BehaviorTree, seen: Inspection) -> Markup:
    """How often each node was reached, and what it answered."""
    rows = [
        (name, f"{count.visits:,}", *_shares(count))
        for name, count in zip(_indented(tree), seen.nodes, strict=True)
    ]  # fmt: skip
    return table("Node by node", ("Node", "Visits", "Success", "Failure", "Running"), rows)


def _parts(notation: str) -> Counter[str]:
    """The sub-trees right below the root, a name for the root first."""
    tree = parse(notation)
    return Counter([format_tree(child) for child in children(tree)] or [notation])


def _difference(old: Counter[str], new: Counter[str]) -> Markup:
    came = [joined([element("ins", part), element("br")]) for part in (new - old).elements()]
    went = [joined([element("del", part), element("br")]) for part in (old - new).elements()]
    return joined([*came, *went]) if came or went else Markup("the root, or the order")


def _bar(share: float) -> Markup:
    left = min(share, 0.0) * _PERCENT / 2 + _PERCENT / 2
    bar = element("rect", x=f"{left:.1f}", y=2, width=f"{abs(share) * _PERCENT / 2:.1f}", height=8)
    line = element("path", d="M50 0V12", class_="grid")
    return element("svg", bar, line, viewBox="0 0 100 12", width=100, height=12, class_="bar", aria_hidden="true")


def _indented(tree: BehaviorTree) -> Iterator[Markup]:
    levels: list[int] = []
    for node, parent in numbered(tree):
        levels.append(0 if parent is None else levels[parent] + 1)
        text = format_leaf(node) if isinstance(node, Action | Condition) else operator(node)
        yield element("span", text, class_="node", style=f"--level:{levels[-1]}")


def _shares(count: NodeCount) -> list[Content]:
    answers = (count.success, count.failure, count.running)
    return ["-" if part is None or not count.visits else f"{part / count.visits:.0%}" for part in answers]
