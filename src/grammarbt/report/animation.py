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

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

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
_DOTS_PER_INCH = 80


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
    stage.figure.savefig(path, dpi=3 * _DOTS_PER_INCH)


class _Stage:
    """The two halves of the picture, drawn tick by tick."""

    def __init__(self, tree: BehaviorTree, episode: Episode) -> None:
        self._drawing, self._episode = lay_out(tree), episode
        self._statuses: list[Statuses] = [(None,) * len(self._drawing.nodes), *statuses_of(tree, episode)]
        self.figure, (self._world, self._tree) = _halves(episode.box, self._drawing.width / self._drawing.height)
        self._scale = _fitted(self._tree, self._drawing.width)
        self._pictures = episode.pictures()
        self._marks = next(self._pictures)
        self._artists: dict[str, tuple[Mark, list[Artist]]] = {}
        self._shown = 0
        self._coloured: Statuses = ()
        left, bottom, right, top = episode.box
        self._world.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
        self._world.axis("off")

    def show(self, tick: int) -> list[Axes]:
        """Draw the state after so many ticks, which may only grow from call to call."""
        reward = self._episode.frames[tick - 1].reward if tick else 0.0
        self._world.set_title(f"tick {tick}, {self._episode.unit or 'reward'} {reward:g}", fontsize=9)
        for _ in range(self._shown, tick):
            self._marks = next(self._pictures)
        self._shown = tick
        self._draw_world()
        self._draw_tree(self._statuses[tick])
        return [self._world, self._tree]

    def _draw_world(self) -> None:
        """Draw anew what is not what it was."""
        letter = (self._episode.box[3] - self._episode.box[1]) / 60
        for order, (name, mark) in enumerate(self._marks.items()):
            before, artists = self._artists.get(name, (None, []))
            if mark != before:
                for artist in artists:
                    artist.remove()
                self._artists[name] = mark, _draw_mark(self._world, mark, order, letter)

    def _draw_tree(self, statuses: Statuses) -> None:
        if statuses == self._coloured:
            return
        self._coloured = statuses
        self._tree.clear()
        self._tree.axis("off")
        self._tree.set(xlim=(0, self._drawing.width), ylim=(self._drawing.height, 0), aspect="equal")
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


def _draw_mark(axes: Axes, mark: Mark, order: int, letter: float) -> list[Artist]:
    """Draw a mark and its label; `letter` is how far above it that stands."""
    style = dict[str, Any](color=_LOOKS[mark.role], alpha=mark.shade, zorder=order)
    drawn: list[Artist] = []
    if mark.shape == "line":
        drawn += axes.plot((mark.x, mark.to_x), (mark.y, mark.to_y), linewidth=1, scalex=False, scaley=False, **style)
    elif mark.shape != "text":
        drawn.append(axes.add_patch(_patch(mark, style)))
    if mark.label and mark.shade > 0:
        above = 0.0 if mark.shape == "text" else mark.size / 2 + letter
        place = dict[str, Any](ha="center", va="center", zorder=order)
        drawn.append(axes.text(mark.x, mark.y + above, mark.label, fontsize=7, parse_math=False, **place))
    return drawn


def _patch(mark: Mark, style: dict[str, Any]) -> Patch:
    from matplotlib.patches import Circle, RegularPolygon  # noqa: PLC0415 - an extra

    place = (mark.x, mark.y)
    if mark.shape == "circle":
        return Circle(place, mark.size / 2, **style)
    if mark.shape == "square":
        return RegularPolygon(place, 4, radius=mark.size / 2**0.5, orientation=mark.angle + pi / 4, **style)
    return RegularPolygon(place, 3, radius=mark.size * 0.6, orientation=mark.angle - pi / 2, **style)
