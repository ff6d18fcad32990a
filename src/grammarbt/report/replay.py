"""An episode as a page: the world beside the tree, tick by tick."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import format_tree
from grammarbt.bt.formats import svg
from grammarbt.report.markup import Markup, data, details, element, joined, page, paragraph, scrolling
from grammarbt.report.recording import recording

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.bt import BehaviorTree
    from grammarbt.domain import Episode

_SPEEDS = (1, 2, 5, 10, 20, 60)
_USUAL_SPEED = 5

_BUTTONS = (
    ("start", "|◀", "To the start", "Home"),
    ("previous-stop", "◀◀", "Previous event", "p"),
    ("back", "◀", "Step back", "←"),
    ("play", "Play", None, "Space"),
    ("forward", "▶", "Step forward", "→"),
    ("next-stop", "▶▶", "Next event", "n"),
    ("end", "▶|", "To the end", "End"),
)
"""Of the controls: name, what is on it, what it is called where that says too little, key."""

_MORE_KEYS = (("+ and -", "faster and slower"), ("z and x", "a larger and a smaller tree"))
_CUES = (
    ("success", "✓", "succeeded"), ("failure", "✗", "failed"), ("running", "…", "running"), ("none", "", "not visited"),
)  # fmt: skip


def replay_page(title: str, tree: BehaviorTree, episode: Episode) -> str:
    """The page.

    Args:
        title: its heading: which tree, where.
        tree: that ran.
        episode: what happened.
    """
    content = recording(tree, episode)
    views = element("div", _world(), _tree(tree), class_="views")
    header = element("header", element("h1", title))
    main = element("main", _controls(len(episode.frames)), views, _stops(content["stops"]), _keys())
    needs = element("noscript", paragraph("This page needs JavaScript, which it brings along."))
    return page(title, ("page.css", "replay.css"), joined([header, needs, main, data("episode", content)]), "replay.js")


def _controls(ticks: int) -> Markup:
    buttons = [
        element("button", sign, id=name, type="button", aria_label=label, title=f"{label or 'Play or pause'} ({key})")
        for name, sign, label, key in _BUTTONS
    ]
    speeds = [element("option", f"{each}", value=each, selected=each == _USUAL_SPEED) for each in _SPEEDS]
    speed = element("label", "Ticks a second ", element("select", *speeds, id="speed"))
    slider = element("input", type="range", id="tick", min=0, max=ticks, value=0, step=1, aria_label="Tick")
    now = element("p", id="now", role="status")
    row = element("div", *buttons, speed, class_="buttons", role="toolbar", aria_label="Controls")
    return element("section", row, slider, now, class_="controls", aria_label="Playing")


def _world() -> Markup:
    picture = element("svg", id="world", role="img", aria_label="The world at this tick")
    return element("figure", element("figcaption", "The world"), picture, class_="world")


def _tree(tree: BehaviorTree) -> Markup:
    picture = Markup(svg.dumps(tree).replace("<svg ", '<svg id="tree" role="img" ', 1))
    cues = [
        element("li", element("span", cue, class_="swatch", data_status=status, aria_hidden="true"), name)
        for status, cue, name in _CUES
    ]
    zoom = [
        element("button", sign, id=name, type="button", aria_label=label)
        for name, sign, label in (("larger", "+", "Larger tree"), ("smaller", "−", "Smaller tree"))
    ]
    follow = element("label", element("input", type="checkbox", id="follow", checked=True), " follow what is ticked")
    tools = element("div", *zoom, follow, class_="buttons")
    legend = element("ul", *cues, class_="cues")
    text = details("In one line", element("pre", element("code", format_tree(tree)), tabindex="0"))
    caption = element("figcaption", "The tree")
    return element("figure", caption, legend, tools, scrolling("The tree", picture), text, class_="tree")


def _stops(stops: Sequence[Sequence[int | str]]) -> Markup | None:
    if not stops:
        return None
    items = [
        element("li", element("button", f"{tick}: {text}", type="button", data_tick=tick, class_="stop"))
        for tick, text in stops
    ]
    listed = scrolling("Events", element("ol", *items, class_="stops"))
    return element("section", element("h2", "Events"), listed, aria_label="Events")


def _keys() -> Markup:
    named = [(key, label.lower() if label else "play or pause") for _, _, label, key in _BUTTONS]
    items = [joined([element("dt", element("kbd", key)), element("dd", text)]) for key, text in (*named, *_MORE_KEYS)]
    return details("Keys", element("dl", *items, class_="keys"))
