"""Sphinx: sphinx-build -W docs docs/_build."""

project = "grammarbt"
author = "The grammarbt developers"
copyright = "2026, the grammarbt developers"  # noqa: A001 - Sphinx's name for it
extensions = ["myst_parser"]
exclude_patterns = ["_build", "examples/**"]
html_theme = "furo"
html_title = "grammarbt"
html_static_path: list[str] = []
myst_heading_anchors = 3
myst_enable_extensions = ["colon_fence", "dollarmath"]
# The grammar language has no lexer of its own, and listings of it are plain text.
suppress_warnings = ["misc.highlighting_failure"]
