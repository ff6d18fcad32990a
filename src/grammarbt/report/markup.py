"""HTML out: every text is escaped unless it is `Markup` already."""

from __future__ import annotations

import json
from html import escape
from importlib import resources
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_EMPTY = ("col", "input", "meta")
"""Elements without an end tag."""


class Markup(str):
    """HTML that is safe to put into a page as it stands."""

    __slots__ = ()


Content: TypeAlias = "str | int | None"
"""A piece of a page: a text to escape, `Markup`, or nothing."""


def element(tag: str, *content: Content, **attributes: str | float | bool | None) -> Markup:
    """An element with its content.

    Args:
        tag: its name.
        content: pieces, one after the other; None is left out.
        attributes: by name; `class_` means `class`, and `aria_label` means `aria-label`. None and False are left out.
    """
    start = f"<{tag}{''.join(_attribute(name, value) for name, value in attributes.items())}>"
    return Markup(start if tag in _EMPTY else f"{start}{joined(content)}</{tag}>")


def joined(content: Iterable[Content]) -> Markup:
    """Pieces, one after the other."""
    return Markup("".join(_piece(each) for each in content))


def section(name: str, heading: str, *content: Content) -> Markup:
    """A section of a page, which its heading names; `name` is its anchor."""
    title = element("h2", heading, id=f"{name}-heading")
    return element("section", title, *content, id=name, aria_labelledby=f"{name}-heading")


def paragraph(*content: Content) -> Markup:
    """A paragraph."""
    return element("p", *content)


def details(summary: str, *content: Content) -> Markup:
    """Something to open."""
    return element("details", element("summary", summary), *content)


def scrolling(label: str, content: Content) -> Markup:
    """A frame for what may be wider than the page; it can be scrolled with the keyboard."""
    return element("div", content, class_="scroll", role="group", aria_label=label, tabindex="0")


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[Content]]) -> Markup:
    """A table; the first cell of each row is its heading."""
    top = element("tr", *(element("th", cell, scope="col") for cell in head))
    lines = (
        element("tr", element("th", row[0], scope="row"), *(element("td", cell) for cell in row[1:])) for row in rows
    )
    return scrolling(
        caption,
        element("table", element("caption", caption), element("thead", top), element("tbody", *lines)),
    )


def data(name: str, value: object) -> Markup:
    """JSON for a script to read, which nothing in a text can end."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    return element("script", Markup(text), type="application/json", id=name)


def page(title: str, style: Sequence[str], body: Content, script: str | None = None) -> str:
    """A page that needs nothing from elsewhere.

    Args:
        title: of the window.
        style: CSS files of `web`.
        body: what it shows.
        script: a file of `web` to run.
    """
    css = Markup("".join(_file(name) for name in style))
    head = element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("meta", name="color-scheme", content="light dark"),
        element("title", title),
        element("style", css),
    )
    run = element("script", Markup(_file(script))) if script else None
    return "<!doctype html>\n" + element("html", head, element("body", body, run), lang="en") + "\n"


def _file(name: str) -> str:
    return resources.files("grammarbt.report").joinpath("web", name).read_text(encoding="utf-8")


def _piece(content: Content) -> str:
    if content is None:
        return ""
    return content if isinstance(content, Markup) else escape(str(content))


def _attribute(name: str, value: str | float | bool | None) -> str:
    if value is None or value is False:
        return ""
    plain = name.rstrip("_").replace("_", "-")
    return f" {plain}" if value is True else f' {plain}="{escape(str(value))}"'
