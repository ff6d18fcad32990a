"""Line charts as SVG inside a page, each with its figures as a table; colours and dashes stand in `page.css`."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, floor, isfinite, log10
from typing import TypeAlias

from attrs import field, frozen

from grammarbt.report.markup import Content, Markup, details, element, joined, table

_WIDTH, _HEIGHT = 720.0, 320.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 64.0, 12.0, 12.0, 44.0
_STEPS = 5
_STYLES = 6
"""Looks of lines in `page.css`; a seventh line looks like the first."""

Span: TypeAlias = tuple[float, float]


@frozen
class Reading:
    """A point of a line with the ends of its interval."""

    x: float
    y: float
    low: float
    high: float


@frozen
class Line:
    """A line of a chart: what it is called, and its points from left to right."""

    name: str
    readings: tuple[Reading, ...]


@frozen
class Chart:
    """A chart.

    Attributes:
        title: says what is to be seen.
        x_name, y_name: what the axes measure; the horizontal one is logarithmic.
        lines: what is drawn.
        level: a value to compare with, dashed; its name comes first.
    """

    title: str
    x_name: str
    y_name: str
    lines: tuple[Line, ...]
    level: tuple[str, float] | None = None
    _frame: _Frame = field(init=False)

    @_frame.default
    def _fitted(self) -> _Frame:
        readings = [reading for line in self.lines for reading in line.readings]
        ys = [y for reading in readings for y in (reading.y, reading.low, reading.high)]
        return _Frame(_span([log10(each.x) for each in readings]), _span(ys + ([self.level[1]] if self.level else [])))

    def figure(self) -> Markup:
        """The chart with its legend, and the figures to open."""
        names = [(f"line-{number % _STYLES}", line.name) for number, line in enumerate(self.lines)]
        legend = [_entry(style, name) for style, name in [*names, *([("level", self.level[0])] if self.level else [])]]
        rows = [
            (line.name, f"{each.x:,.0f}", f"{each.y:.5g}", f"{each.low:.5g} to {each.high:.5g}")
            for line in self.lines
            for each in line.readings
        ]
        return element(
            "figure",
            element("figcaption", self.title),
            self._picture(),
            element("ul", *legend, class_="legend"),
            details(
                "The figures as a table", table(self.title, ("Line", self.x_name, self.y_name, "95 % interval"), rows)
            ),
        )

    def _picture(self) -> Markup:
        frame = self._frame
        parts = [_axis_names(self.x_name, self.y_name), *frame.x_ticks(), *frame.y_ticks()]
        if self.level:
            y = frame.y(self.level[1])
            parts.append(element("path", d=f"M{_LEFT} {y:.1f}H{_WIDTH - _RIGHT}", class_="level"))
        for number, line in enumerate(self.lines):
            parts.append(element("g", *_drawn(line, frame), class_=f"line-{number % _STYLES}"))
        return element("svg", *parts, viewBox=f"0 0 {_WIDTH:g} {_HEIGHT:g}", role="img", aria_label=self.title)


@frozen
class _Frame:
    """From values to places in the picture; the horizontal span is one of decimal logarithms."""

    x_span: Span
    y_span: Span

    def x(self, value: float) -> float:
        low, high = self.x_span
        return _LEFT + (log10(value) - low) / (high - low) * (_WIDTH - _LEFT - _RIGHT)

    def y(self, value: float) -> float:
        low, high = self.y_span
        return _HEIGHT - _BOTTOM - (value - low) / (high - low) * (_HEIGHT - _TOP - _BOTTOM)

    def x_ticks(self) -> list[Markup]:
        low, high = self.x_span
        powers = [10.0**power for power in range(ceil(low), floor(high) + 1)]
        return [_x_tick(self.x(value), f"{value:,.0f}") for value in powers or [10**low, 10**high]]

    def y_ticks(self) -> list[Markup]:
        return [_y_tick(self.y(value), f"{value:g}") for value in round_values(*self.y_span)]


def round_values(low: float, high: float) -> list[float]:
    """About five round numbers between two others."""
    raw = (high - low) / _STEPS
    power = 10.0 ** floor(log10(raw))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= raw)
    return [round(number * step, 12) for number in range(ceil(low / step), floor(high / step) + 1)]


def _span(values: Sequence[float]) -> Span:
    """From the lowest to the highest value, with some air; never empty."""
    known = [value for value in values if isfinite(value)] or [0.0]
    low, high = min(known), max(known)
    air = (high - low) * 0.04 or max(abs(low), 1.0) * 0.1
    return low - air, high + air


def _drawn(line: Line, frame: _Frame) -> list[Content]:
    places = [(frame.x(each.x), frame.y(each.y), frame.y(each.low), frame.y(each.high)) for each in line.readings]
    if not places:
        return []
    upper = " ".join(f"{x:.1f},{high:.1f}" for x, _, _, high in places)
    lower = " ".join(f"{x:.1f},{low:.1f}" for x, _, low, _ in reversed(places))
    middle = " ".join(f"{x:.1f},{y:.1f}" for x, y, _, _ in places)
    dots = [element("circle", cx=f"{x:.1f}", cy=f"{y:.1f}", r="2.5") for x, y, _, _ in places]
    band = element("polygon", points=f"{upper} {lower}", class_="band")
    return [band, element("polyline", points=middle, class_="curve"), *dots]


def _axis_names(x_name: str, y_name: str) -> Markup:
    middle = (_HEIGHT - _BOTTOM + _TOP) / 2
    across = element("text", x_name, x=(_WIDTH + _LEFT) / 2, y=_HEIGHT - 8, class_="middle")
    return joined([across, element("text", y_name, transform=f"translate(14 {middle:g}) rotate(-90)", class_="middle")])


def _x_tick(x: float, text: str) -> Markup:
    line = element("path", d=f"M{x:.1f} {_TOP}V{_HEIGHT - _BOTTOM}", class_="grid")
    return joined([line, element("text", text, x=f"{x:.1f}", y=_HEIGHT - _BOTTOM + 16, class_="middle")])


def _y_tick(y: float, text: str) -> Markup:
    line = element("path", d=f"M{_LEFT} {y:.1f}H{_WIDTH - _RIGHT}", class_="grid")
    return joined([line, element("text", text, x=_LEFT - 6, y=f"{y + 4:.1f}", class_="end")])


def _entry(style: str, name: str) -> Markup:
    sample = element(
        "svg", element("path", d="M0 6H28", class_="curve" if style != "level" else "level"), viewBox="0 0 28 12",
        width="28", height="12", class_=style, aria_hidden="true",
    )  # fmt: skip
    return element("li", sample, name)
