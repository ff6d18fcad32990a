"""The tree formats that come with grammarbt."""

from __future__ import annotations

from grammarbt.plugins.specs import FormatSpec

_PACKAGE = "grammarbt.bt.formats"


def _written(name: str, module: str, suffix: str, text: str) -> FormatSpec:
    return FormatSpec(name, (suffix,), f"{_PACKAGE}.{module}:dumps", None, text)


def _plotted(name: str, text: str) -> FormatSpec:
    return FormatSpec(name, (f".{name}",), f"{_PACKAGE}.plot:{name}", None, text)


def _both_ways(name: str, module: str, suffixes: tuple[str, ...], text: str) -> FormatSpec:
    return FormatSpec(name, suffixes, f"{_PACKAGE}.{module}:dumps", f"{_PACKAGE}.{module}:loads", text)


FORMATS = (
    FormatSpec(
        "notation", (".bt",), "grammarbt.bt:format_tree", "grammarbt.bt:parse", "The paper's notation, on one line."
    ),
    _both_ways("tree", "indented", (".tree",), "Indented, a node a line; reads tabs and bars."),
    _both_ways("btcpp", "btcpp", (".xml",), "BehaviorTree.CPP 4, XML."),
    _written("py_trees", "py_trees", ".py", "A Python module for py_trees 2."),
    _written("py_trees_xml", "py_trees_xml", ".xml", "The XML that py_trees 2.6 reads."),
    _both_ways("json", "json_format", (".json",), "JSON."),
    _both_ways("strings", "strings", (".txt",), "The string lists of Styrud and Iovino."),
    _written("dot", "dot", ".dot", "Graphviz."),
    _written("mermaid", "mermaid", ".mmd", "A Mermaid flowchart."),
    _written("svg", "svg", ".svg", "A picture, as SVG."),
    _plotted("png", "A picture, as PNG; needs matplotlib."),
    _plotted("pdf", "A picture, as PDF; needs matplotlib."),
)
