"""PNG and PDF pictures, like the SVG ones. Importing this module needs matplotlib."""

from __future__ import annotations

import io
import warnings
from typing import TYPE_CHECKING, Any

from grammarbt.bt.layout import HEIGHT, Drawing, Placed, lay_out
from grammarbt.bt.model import BehaviorTree, Condition, Not
from grammarbt.errors import FormatError

try:
    import matplotlib as mpl
    from matplotlib.figure import Figure
    from matplotlib.patches import Ellipse, Patch, Polygon, Rectangle
except ImportError:
    raise FormatError("PNG and PDF need matplotlib", "pip install 'grammarbt[plots]', or convert to svg") from None

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

_POINTS_PER_INCH = 72
_MOST_POINTS = 10_000
"""On a side; larger pictures are scaled down to it. Viewers show PDF pages of up to 14,400."""

_DOTS_PER_POINT = 2


def png(tree: BehaviorTree) -> bytes:
    """Draw a tree in pixels."""
    return _saved(_figure(tree), format="png", dpi=_DOTS_PER_POINT * _POINTS_PER_INCH)


def pdf(tree: BehaviorTree) -> bytes:
    """Draw a tree on a page of its size: lines, and text in a font that the file brings; the same bytes every time."""
    with mpl.rc_context({"pdf.fonttype": 42}):  # TrueType: text that can be searched and edited
        return _saved(_figure(tree), format="pdf", metadata={"CreationDate": None})


def _saved(figure: Figure, **options: Any) -> bytes:  # noqa: ANN401 - matplotlib's own
    file = io.BytesIO()
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # a script the font lacks is drawn as boxes
        figure.savefig(file, **options)
    return file.getvalue()


def _figure(tree: BehaviorTree) -> Figure:
    drawing = lay_out(tree)
    scale = min(1.0, _MOST_POINTS / max(drawing.width, drawing.height))
    figure = Figure(figsize=(drawing.width * scale / _POINTS_PER_INCH, drawing.height * scale / _POINTS_PER_INCH))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, drawing.width), ylim=(drawing.height, 0))
    axes.axis("off")
    draw_tree(axes, drawing, scale)
    return figure


def draw_tree(axes: Axes, drawing: Drawing, scale: float, fills: Sequence[str] | None = None) -> None:
    """Draw a tree into axes that count its pixels from the top left.

    Args:
        axes: where to draw.
        drawing: the placed nodes.
        scale: of letters and lines.
        fills: the colour of each node; white unless given.
    """
    for node, fill in zip(drawing.nodes, fills or ["white"] * len(drawing.nodes), strict=True):
        if node.parent is not None:
            parent = drawing.nodes[node.parent]
            axes.plot((parent.x, node.x), (parent.y, node.y), color="black", linewidth=scale, zorder=0)
        axes.add_patch(_patch(node, scale, fill))
        axes.text(node.x, node.y, node.text, ha="center", va="center", fontsize=11 * scale, parse_math=False)


def _patch(placed: Placed, scale: float, fill: str) -> Patch:
    x, y, half, width = placed.x, placed.y, HEIGHT / 2, placed.width
    look: dict[str, Any] = {"facecolor": fill, "edgecolor": "black", "linewidth": scale}
    if isinstance(placed.node, Condition):
        return Ellipse((x, y), width, HEIGHT, **look)
    if isinstance(placed.node, Not):
        return Polygon([(x, y - half), (x + half, y), (x, y + half), (x - half, y)], **look)
    return Rectangle((x - width / 2, y - half), width, HEIGHT, **look)
