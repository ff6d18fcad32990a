"""File formats of trees, a module each, with `dumps(tree)` and, where it can be read, `loads(text)`; `plot` has two.

`grammarbt.plugins.builtin_formats` lists them by name.
"""
