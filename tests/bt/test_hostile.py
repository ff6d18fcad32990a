"""Files that are damaged, or meant to do damage."""

from __future__ import annotations

import time
from importlib import import_module

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import format_tree, parse
from grammarbt.bt.formats import json_format, strings
from grammarbt.bt.formats.files import MAX_BYTES, decode, read_text
from grammarbt.errors import FormatError, GrammarBTError
from grammarbt.plugins.builtin_formats import FORMATS

TWO_WAY = [spec for spec in FORMATS if spec.importer]
TREE = parse("?( →( (mine found) (is armed) [disarm] ) →( !(carrying object) [pick up(arm=left)] ) )")


def call(path):
    module, _, name = path.partition(":")
    return getattr(import_module(module), name)


def bt(inside):
    tree = f'<BehaviorTree ID="M">{inside}</BehaviorTree>'
    return f'<root BTCPP_format="4">{tree}<TreeNodesModel><Action ID="a"/></TreeNodesModel></root>'


def attempt(read, text):
    try:
        return read(text)
    except GrammarBTError as error:
        return error


BOMB = '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;"><!ENTITY c "&b;&b;&b;&b;">]>'
HOSTILE = {
    "entity bomb": BOMB + bt("<a name='&c;'/>"),
    "external entity": '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]>' + bt("<a name='&x;'/>"),
    "external document type": '<!DOCTYPE r SYSTEM "http://example.org/x.dtd">' + bt("<a/>"),
    "undefined entity": bt("<a name='&x;'/>"),
    "deep xml": '<root BTCPP_format="4"><BehaviorTree ID="M">' + "<Inverter>" * 100_000,
    "deep json": '{"grammarbt": 1, "tree": ' + '{"type": "not", "child": ' * 100_000,
    "deep list": "[" + "'s(', " * 100_000 + "]",
    "deep json list": "[" * 100_000,
    "deep tabs": "\n".join("\t" * level + "->" for level in range(1000)),
    "deep bars": "\n".join("|" * level + "?" for level in range(1000)),
    "many negations": "!" * 100_000 + "(c)",
    "spaces": "(" + " " * 100_000 + "[" + "\n",
    "braces": "[a" + " " * 100_000 + "{" + " " * 100_000 + "]",
    "quotes": "['" + "\\" * 100_000,
    "truncated xml": bt("<a/>")[:60],
    "truncated json": json_format.dumps(TREE)[:100],
    "truncated list": strings.dumps(TREE)[:50],
    "binary": "".join(map(chr, range(1, 256))),
    "surrogates": "\ud800\udc00\ud800",
    "nothing": "",
    "huge number": "|| " + "9" * 10_000 + "\n\t[a]",
}


@pytest.mark.parametrize("name", HOSTILE)
@pytest.mark.parametrize("spec", TWO_WAY, ids=lambda spec: spec.name)
def test_hostile_input_is_refused_in_one_line(spec, name):
    begin = time.process_time()
    with pytest.raises(GrammarBTError) as caught:
        call(spec.importer)(HOSTILE[name])
    assert time.process_time() - begin < 2
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 400


@settings(max_examples=200, deadline=None)
@given(data=st.data())
def test_damaged_exports_are_trees_or_errors(data, any_trees):
    spec = data.draw(st.sampled_from(TWO_WAY))
    text = call(spec.exporter)(data.draw(any_trees))
    start, stop = sorted(data.draw(st.tuples(st.integers(0, len(text)), st.integers(0, len(text)))))
    result = attempt(call(spec.importer), text[:start] + data.draw(st.text(max_size=3)) + text[stop:])
    assert "\n" not in (str(result) if isinstance(result, GrammarBTError) else format_tree(result))


def test_files_that_are_no_text_are_refused(tmp_path):
    path = tmp_path / "tree.xml"
    for data in (b"\x89PNG\r\n\x1a\n", b"a\0b", "?".encode("utf-16")):
        path.write_bytes(data)
        with pytest.raises(FormatError, match="not text"):
            read_text(path)
    with pytest.raises(FormatError, match="cannot read"):
        read_text(tmp_path / "none.xml")
    path.write_bytes(b" " * (MAX_BYTES + 1))
    with pytest.raises(FormatError, match="larger than 16 MiB"):
        read_text(path)
    assert decode("\ufeff[a]".encode(), "x") == "[a]"
