"""An episode as a moving or a still picture: the world beside the tree, drawn with matplotlib."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

from grammarbt.bt import BehaviorTree, Status
from grammarbt.bt.formats.plot import draw_tree
from grammarbt.bt.layout import HEIGHT, lay_out
from grammarbt.report.recording import statuses_of

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from grammarbt.domain import Episode, Mark
    from grammarbt.report.recording import Statuses

_FILLS = {Status.SUCCESS: "#8fd694", Status.FAILURE: "#f4a09a", Status.RUNNING: "#9cc4f5", None: "white"}
_CUES = {Status.SUCCESS: "✓", Status.FAILURE: "✗", Status.RUNNING: "…", None: ""}
_LOOKS = {
    "ground": "#d9dde2", "path": "#8b949e", "place": "#6b747d", "robot": "#0b62a4", "goal": "#00694a",
    "hazard": "#c2272d", "object": "#a34700", "belief": "#5a4fcf", "note": "#1c1f23",
}  # fmt: skip
_HEIGHT = 4.8
"""Inches; each half is as wide as it needs, within bounds."""
_NARROWEST, _WIDEST = 4.0, 11.0
_RIM, _TOP = 0.01, 0.92
"""Shares of the picture around each half, and its height, which leaves room for a caption."""
_FRAMES_PER_SECOND = 8
_DOTS_PER_INCH = 100


def save_gif(tree: BehaviorTree, episode: Episode, path: Path) -> None:
    """Every tick, eight a second."""
    from matplotlib.animation import FuncAnimation, PillowWriter  # noqa: PLC0415 - an extra

    stage = _Stage(tree, episode)
    frames = range(len(episode.frames) + 1)
    moving = FuncAnimation(stage.figure, stage.show, frames=frames, init_func=list, blit=False)
    moving.save(path, writer=PillowWriter(fps=_FRAMES_PER_SECOND), dpi=_DOTS_PER_INCH)


def save_still(tree: BehaviorTree, episode: Episode, tick: int, path: Path) -> None:
    """One tick, counted from 1; 0 is the world before the first."""
    stage = _Stage(tree, episode)
    stage.show(tick)
    stage.figure.savefig(path, dpi=2 * _DOTS_PER_INCH)


class _Stage:
    """The two halves of the picture, drawn tick by tick."""

    def __init__(self, tree: BehaviorTree, episode: Episode) -> None:
        self._drawing, self._episode = lay_out(tree), episode
        self._statuses: list[Statuses] = [(None,) * len(self._drawing.nodes), *statuses_of(tree, episode)]
        self.figure, (self._world, self._tree) = _halves(episode.box, self._drawing.width / self._drawing.height)
        self._scale = _fitted(self._tree, self._drawing.width)

    def show(self, tick: int) -> list[Axes]:
        """Draw the state after so many ticks."""
        for half in (self._world, self._tree):
            half.clear()
            half.axis("off")
        reward = self._episode.frames[tick - 1].reward if tick else 0.0
        self._world.set_title(f"tick {tick}, {self._episode.unit or 'reward'} {reward:g}", fontsize=9)
        self._draw_world(tick)
        self._draw_tree(self._statuses[tick])
        return [self._world, self._tree]

    def _draw_world(self, tick: int) -> None:
        left, bottom, right, top = self._episode.box
        self._world.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
        marks = {mark.name: mark for mark in self._episode.marks}
        for frame in self._episode.frames[:tick]:
            marks.update((mark.name, mark) for mark in frame.changes)
        for order, mark in enumerate(marks.values()):
            _draw_mark(self._world, mark, order, (top - bottom) / 60)

    def _draw_tree(self, statuses: Statuses) -> None:
        width, height = self._drawing.width, self._drawing.height
        self._tree.set(xlim=(0, width), ylim=(height, 0), aspect="equal")
        draw_tree(self._tree, self._drawing, self._scale, [_FILLS[status] for status in statuses])
        for node, status in zip(self._drawing.nodes, statuses, strict=True):
            corner = (node.x + node.width / 2, node.y - HEIGHT / 2)
            self._tree.text(*corner, _CUES[status], ha="center", va="center", fontsize=10 * self._scale)


def _halves(box: tuple[float, float, float, float], tree_shape: float) -> tuple[Figure, tuple[Axes, Axes]]:
    from matplotlib.figure import Figure  # noqa: PLC0415 - an extra

    left, bottom, right, top = box
    shapes = ((right - left) / max(top - bottom, 1e-9), tree_shape)
    widths = [min(_WIDEST, max(_NARROWEST, _HEIGHT * shape)) for shape in shapes]
    figure, total = Figure(figsize=(sum(widths), _HEIGHT)), sum(widths)
    lefts = (_RIM, widths[0] / total + _RIM)
    world, tree = (
        figure.add_axes((left, _RIM, width / total - 2 * _RIM, _TOP)) for left, width in zip(lefts, widths, strict=True)
    )
    return figure, (world, tree)


def _fitted(axes: Axes, width: float) -> float:
    """What to scale letters and lines by, so that a drawing so many points wide fits."""
    figure = axes.get_figure(root=True)
    share = axes.get_position().width
    return float(figure.get_figwidth() * share * 72 / width) if figure else 1.0


def _draw_mark(axes: Axes, mark: Mark, order: int, letter: float) -> None:
    from matplotlib.patches import Circle, RegularPolygon  # noqa: PLC0415 - an extra

    colour, style = _LOOKS[mark.role], dict[str, Any](alpha=mark.shade, zorder=order)
    if mark.shape == "line":
        axes.plot((mark.x, mark.to_x), (mark.y, mark.to_y), color=colour, linewidth=1, **style)
    elif mark.shape == "circle":
        axes.add_patch(Circle((mark.x, mark.y), mark.size / 2, color=colour, **style))
    elif mark.shape in ("square", "triangle"):
        corners, turn = (4, pi / 4) if mark.shape == "square" else (3, -pi / 2)
        radius = mark.size / 2**0.5 if mark.shape == "square" else mark.size * 0.6
        place = (mark.x, mark.y)
        axes.add_patch(
            RegularPolygon(place, corners, radius=radius, orientation=mark.angle + turn, color=colour, **style)
        )
    if mark.label and mark.shade > 0:
        above = 0.0 if mark.shape == "text" else mark.size / 2 + letter
        axes.text(mark.x, mark.y + above, mark.label, ha="center", va="center", fontsize=7, parse_math=False)
