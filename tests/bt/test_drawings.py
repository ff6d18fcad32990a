"""Pictures and graphs of trees."""

from __future__ import annotations

import io
import re
import struct
from itertools import pairwise
from xml.etree import ElementTree as ET

import pydot
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pypdf import PdfReader

from grammarbt.bt import Action, Condition, Fallback, format_tree, parse, walk
from grammarbt.bt.formats import dot, mermaid, plot, svg
from grammarbt.bt.layout import GAP, HEIGHT, lay_out


@settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_svg_is_well_formed_and_shows_every_name(data, any_trees):
    tree = data.draw(any_trees)
    root = ET.fromstring(svg.dumps(tree))  # noqa: S314 – written just now
    texts = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert len(texts) == len(list(walk(tree)))
    assert root.find("{http://www.w3.org/2000/svg}title").text == format_tree(tree)


@settings(max_examples=100, deadline=None)
@given(data=st.data())
def test_nodes_of_a_drawing_do_not_overlap(data, any_trees):
    drawing = lay_out(data.draw(any_trees))
    rows = {}
    for node in drawing.nodes:
        rows.setdefault(node.y, []).append((node.x - node.width / 2, node.x + node.width / 2))
    for row in rows.values():
        assert all(right + GAP / 2 <= left for (_, right), (left, _) in pairwise(row))
        assert row[0][0] >= 0
        assert row[-1][1] <= drawing.width
    assert max(rows) + HEIGHT / 2 <= drawing.height


AWKWARD = Fallback(
    (Action('a"b\\c'), Condition("&amp; <b> `x`"), Action("\\n \\G"), Condition("end"), Action("$x$ 搬运"))
)


@pytest.mark.filterwarnings("ignore:.*deprecated:DeprecationWarning")  # pydot's, of its parser
def test_dot_keeps_awkward_names_as_they_are():
    (graph,) = pydot.graph_from_dot_data(dot.dumps(AWKWARD))
    labels = [node.get("label") for node in graph.get_nodes() if re.fullmatch(r"n\d+", node.get_name())]
    assert len(labels) == 6
    assert len(graph.get_edges()) == 5
    assert r'"a\"b\\c"' in labels
    assert '"&amp;amp; <b> `x`"' in labels
    assert r'"\\n \\G"' in labels


def test_mermaid_escapes_all_that_means_something():
    lines = mermaid.dumps(AWKWARD).splitlines()
    assert lines[0] == "flowchart TD"
    assert len(lines) == 1 + 6 + 5
    labels = [re.fullmatch(r'  n\d+[\[({]+"(.*)"[\])}]+', line).group(1) for line in lines[1:7]]
    plain = [re.sub(r"#(\d+);", lambda found: chr(int(found.group(1))), label) for label in labels]
    assert plain[1:] == ['a"b\\c', "&amp; <b> `x`", "\\n \\G", "end", "$x$ 搬运"]
    assert not set("".join(labels).replace("#", "").replace(";", "")) & set('"<>&`\\$.')


def test_png_draws_any_name_without_a_warning():
    assert plot.png(AWKWARD).startswith(b"\x89PNG")


def test_pdf_holds_the_names_as_text_and_is_the_same_every_time():
    data = plot.pdf(AWKWARD)
    (page,) = PdfReader(io.BytesIO(data)).pages
    shown = page.extract_text()
    assert all(leaf.name in shown for leaf in AWKWARD.children[:4])
    assert not page.images
    assert plot.pdf(AWKWARD) == data


def test_very_wide_trees_are_drawn():
    wide = parse("?( " + "[some long action name] " * 200 + ")")
    width, height = struct.unpack(">II", plot.png(wide)[16:24])
    assert width == 20_000
    assert height > 0
    (page,) = PdfReader(io.BytesIO(plot.pdf(wide))).pages
    assert page.mediabox.width == pytest.approx(10_000, abs=1)
