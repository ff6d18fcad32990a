"""SVG pictures, drawn like the paper's: squares are actions, ovals conditions."""

from __future__ import annotations

from html import escape

from grammarbt.bt.layout import HEIGHT, Placed, lay_out
from grammarbt.bt.model import BehaviorTree, Condition, Not
from grammarbt.bt.notation import format_tree


def dumps(tree: BehaviorTree) -> str:
    """Draw a tree."""
    drawing = lay_out(tree)
    size = f'width="{drawing.width:g}" height="{drawing.height:g}" viewBox="0 0 {drawing.width:g} {drawing.height:g}"'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="13" text-anchor="middle">',
        f"<title>{escape(format_tree(tree))}</title>",
        f'<rect width="{drawing.width:g}" height="{drawing.height:g}" fill="white"/>',
        *(_edge(drawing.nodes[node.parent], node) for node in drawing.nodes if node.parent is not None),
        *(_node(node) for node in drawing.nodes),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _edge(parent: Placed, child: Placed) -> str:
    top, bottom = parent.y + HEIGHT / 2, child.y - HEIGHT / 2
    return f'<path d="M{parent.x:g} {top:g}L{child.x:g} {bottom:g}" stroke="black"/>'


def _node(placed: Placed) -> str:
    text = f'<text x="{placed.x:g}" y="{placed.y + 4.5:g}">{escape(placed.text)}</text>'
    return f'<g><{_shape(placed)} fill="white" stroke="black"/>{text}</g>'


def _shape(placed: Placed) -> str:
    x, y, half, width = placed.x, placed.y, HEIGHT / 2, placed.width
    if isinstance(placed.node, Condition):
        return f'ellipse cx="{x:g}" cy="{y:g}" rx="{width / 2:g}" ry="{half:g}"'
    if isinstance(placed.node, Not):
        return f'path d="M{x:g} {y - half:g}L{x + half:g} {y:g}L{x:g} {y + half:g}L{x - half:g} {y:g}Z"'
    return f'rect x="{x - width / 2:g}" y="{y - half:g}" width="{width:g}" height="{HEIGHT:g}"'
