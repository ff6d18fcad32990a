"""PNG pictures, like the SVG ones. Importing this module needs matplotlib."""

from __future__ import annotations

import io
import warnings
from typing import TYPE_CHECKING

from grammarbt.bt.layout import HEIGHT, Drawing, Placed, lay_out
from grammarbt.bt.model import BehaviorTree, Condition, Not
from grammarbt.errors import FormatError

try:
    from matplotlib.figure import Figure
    from matplotlib.patches import Ellipse, Patch, Polygon, Rectangle
except ImportError:
    raise FormatError("PNG needs matplotlib", "pip install 'grammarbt[plots]', or convert to svg") from None

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SCALE = 2.0
_MOST_PIXELS = 20_000
"""On a side; larger pictures are scaled down to it."""


def dumps(tree: BehaviorTree) -> bytes:
    """Draw a tree."""
    drawing = lay_out(tree)
    scale = min(_SCALE, _MOST_PIXELS / max(drawing.width, drawing.height))
    figure = Figure(figsize=(drawing.width / 72, drawing.height / 72), dpi=72 * scale)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, drawing.width), ylim=(drawing.height, 0))
    axes.axis("off")
    _draw(axes, drawing)
    return _saved(figure)


def _saved(figure: Figure) -> bytes:
    file = io.BytesIO()
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # a script the font lacks is drawn as boxes
        figure.savefig(file, format="png")
    return file.getvalue()


def _draw(axes: Axes, drawing: Drawing) -> None:
    for node in drawing.nodes:
        if node.parent is not None:
            parent = drawing.nodes[node.parent]
            axes.plot((parent.x, node.x), (parent.y, node.y), color="black", linewidth=1, zorder=0)
        axes.add_patch(_patch(node))
        axes.text(node.x, node.y, node.text, ha="center", va="center", fontsize=11, parse_math=False)


def _patch(placed: Placed) -> Patch:
    x, y, half, width = placed.x, placed.y, HEIGHT / 2, placed.width
    if isinstance(placed.node, Condition):
        return Ellipse((x, y), width, HEIGHT, facecolor="white", edgecolor="black")
    if isinstance(placed.node, Not):
        corners = [(x, y - half), (x + half, y), (x, y + half), (x - half, y)]
        return Polygon(corners, facecolor="white", edgecolor="black")
    return Rectangle((x - width / 2, y - half), width, HEIGHT, facecolor="white", edgecolor="black")
