"""Formats: what goes out comes back, and foreign files read as they are meant."""

from __future__ import annotations

import re
from importlib import import_module
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Action, Condition, Fallback, Sequence, format_tree, parse
from grammarbt.bt.formats import btcpp, indented, json_format, py_trees_xml, strings
from grammarbt.bt.formats.slug import slug, tags
from grammarbt.errors import FormatError
from grammarbt.plugins.builtin_formats import FORMATS

MANUAL = parse(
    "?( →( (mine found) (is armed) [disarm] ) →( !(carrying object) [pick up(arm=left)] ) ‖2( [a] (b) [c] ) )"
)


def call(path):
    module, _, name = path.partition(":")
    return getattr(import_module(module), name)


def read_back(text):
    return ET.fromstring(text)  # noqa: S314 – what this very test has written


TWO_WAY = [spec for spec in FORMATS if spec.importer]


@pytest.mark.parametrize("spec", TWO_WAY, ids=lambda spec: spec.name)
@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_importing_an_export_gives_the_same_tree(spec, data, any_trees):
    tree = data.draw(any_trees)
    assert call(spec.importer)(call(spec.exporter)(tree)) == tree


@pytest.mark.parametrize("spec", FORMATS, ids=lambda spec: spec.name)
def test_every_format_writes_the_deepest_tree(spec):
    deepest = parse("!(" * 255 + "[a]" + ")" * 255)
    assert call(spec.exporter)(deepest)


def test_formats_have_the_names_that_users_type():
    assert [spec.name for spec in FORMATS] == [
        *("notation", "tree", "btcpp", "py_trees", "py_trees_xml", "json", "strings"),
        *("dot", "mermaid", "svg", "png", "pdf"),
    ]


# --- indented trees


def test_tabs_with_decorators_parallels_and_suffixes_are_read():
    text = "?\n\t->\n\t\t(mine found {m1})\n\t\t<!>\n\t\t\t(is armed)\n\t\t[disarm]{m1}\n\n\t|| 2\n\t\t[a]\n\t\t[b]\n\t\t(go(x: y))\n"
    expected = "?( →( (mine found(id=m1)) !(is armed) [disarm(id=m1)] ) ‖2( [a] [b] (go(x=y)) ) )"
    assert indented.loads(text) == parse(expected)


def test_bars_with_negations_parallels_and_comments_are_read():
    text = ";; who eats\n?\n|    ->\n|    |    !(Ghost Close)  ;; not (now)\n|    |    [Eat;;Run]\r\n|    =1\n||   [Eat Fruit]\n"
    assert indented.loads(text) == parse("?( →( !(Ghost Close) [Eat;;Run] ) ‖1( [Eat Fruit] ) )")


def test_one_line_notation_in_a_tree_file_is_read():
    assert indented.loads(f"\n{format_tree(MANUAL)}\n") == MANUAL


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no tree"),
        ("?\n\t[a]\n?\n\t[b]", "second tree starts, line 3"),
        ("?\n\t[a]\n\t\t[b]", "has no children, line 3"),
        ("?\n\t[a]\n  [b]", "unlike its siblings, line 3"),
        ("?\n\t[a] [b]", "holds one node.*line 2"),
        ("?\n\tinclude other.tree", "not a node.*line 2"),
        ("?\n\t->", "needs children, line 2"),
        ("<!>\n\t[a]\n\t[b]", "one child, not 2, line 1"),
        ("|| 3\n\t[a]", "cannot wait for 3 successes, line 1"),
        ("?\n\t[]", "line 2"),
        ("?\n\t[spi)]", "line 2"),
    ],
)
def test_an_error_in_an_indented_tree_names_the_line(text, says):
    with pytest.raises(FormatError, match=says):
        indented.loads(text)


# --- BehaviorTree.CPP


def bt(inside, model='<Action ID="a"/><Condition ID="c"/>'):
    tree = f'<BehaviorTree ID="M">{inside}</BehaviorTree>'
    return f'<root BTCPP_format="4">{tree}<TreeNodesModel>{model}</TreeNodesModel></root>'


def test_the_export_for_behaviortree_cpp_avoids_its_traps():
    root = read_back(btcpp.dumps(MANUAL))
    used = {element.tag for element in root.find("BehaviorTree").iter()} - {"BehaviorTree"}
    assert {"ReactiveFallback", "ReactiveSequence", "Inverter", "Parallel"} < used
    assert not used & {"Sequence", "Fallback", "Action", "Condition"}
    assert all(re.fullmatch(r"[A-Za-z_][A-Za-z0-9_-]*", tag) for tag in used)
    declared = {element.attrib["ID"]: element.tag for element in root.find("TreeNodesModel")}
    assert declared["pick_up"] == "Action"
    assert declared["mine_found"] == "Condition"
    leaves = [element for element in root.find("BehaviorTree").iter() if element.tag in declared]
    assert all(key == "name" or key.startswith("_") for leaf in leaves for key in leaf.attrib)
    assert root.find(".//Parallel").attrib == {"success_count": "2", "failure_count": "2"}


def test_files_written_by_hand_are_read():
    text = bt(
        '<ReactiveSequence name="x"><Condition ID="c"/><a name="first one" goal="left" _x="y"/></ReactiveSequence>'
    )
    assert btcpp.loads(text) == Sequence((Condition("c"), Action("a", (("goal", "left"),))))
    assert btcpp.loads(bt('<Parallel success_count="1" failure_count="-1"><a/><c/></Parallel>')) == parse(
        "‖1( [a] (c) )"
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("<root/>", "not XML of BehaviorTree.CPP 4"),
        ('<root BTCPP_format="3"/>', "not XML of BehaviorTree.CPP 4"),
        ('<root BTCPP_format="4"/>', "which of 0 <BehaviorTree>"),
        (bt("<a/>").replace("<TreeN", '<BehaviorTree ID="N"/><TreeN'), "which of 2 <BehaviorTree>"),
        (bt("<a/><a/>"), "one root, not 2"),
        (bt("<Sequence><a/></Sequence>"), "goes on where it was.*use ReactiveSequence"),
        (bt("<Retry><a/></Retry>"), "neither a known node"),
        (bt("<b/>"), "declare actions and conditions"),
        (bt('<SubTree ID="x"/>'), "neither a known node"),
        (bt("<Inverter><a/><a/></Inverter>"), "one child, not 2, at <Inverter> in line 1"),
        (bt("<ReactiveFallback/>"), "needs children"),
        (bt('<a goal="{pose}"/>'), "cannot stand in a leaf's arguments"),
        (bt('<Parallel success_count="2"><a/><a/><a/></Parallel>'), 'fails before 2.*set failure_count="2"'),
        (bt('<Parallel success_count="{n}"><a/></Parallel>'), "success_count is not a number"),
    ],
)
def test_what_would_mean_something_else_is_refused(text, says):
    with pytest.raises(FormatError, match=says):
        btcpp.loads(text)


def test_slugs_are_distinct_and_the_same_in_every_tree():
    tree = Fallback((Action("a b"), Action("a_b"), Condition("a b"), Action("2nd"), Action("a/b"), Action("Sequence")))
    found = tags(tree, btcpp.RESERVED)
    assert found[Action, "a b"] == "a_b"
    assert found[Action, "2nd"] == "_2nd"
    assert found[Action, "a/b"] == "a-2f-b"
    assert found[Action, "Sequence"] == "Sequence_"
    assert len(set(found.values())) == 6
    assert slug("go to comms") == "go_to_comms"


# --- string lists and JSON


def test_string_lists_in_pythons_spelling_are_read():
    text = "['f(', 'task_done?', 's(', 'localise', 'pick!', \"it's\", ')', 'p(', 'a', 'b', ')', ')']"
    assert strings.loads(text) == parse("?( (task_done) →( [localise] [pick] [it's] ) ‖2( [a] [b] ) )")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("f( a )", "not a list of strings"),
        ("['f(', 'a']", "ends with 1 nodes open"),
        ("['a', 'b']", "goes on after the tree, at string 2"),
        ("[')']", "nothing is open.*at string 1"),
        ("['f(', ')']", "needs children, at string 2"),
        ("[]", "ends with 0"),
        ("['f(', a, ')']", "at character 8"),
        ("['f(', '\\x', ')']", "not a string"),
        ("['s(', '(', ')']", "at string 2"),
    ],
)
def test_an_error_in_a_string_list_names_the_string(text, says):
    with pytest.raises(FormatError, match=says):
        strings.loads(text)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("{", "not JSON.*line 1 column 2"),
        ("[]", "no .grammarbt.: 1"),
        ('{"grammarbt": 1}', "tree is not an object"),
        (
            '{"grammarbt": 1, "tree": {"type": "fallback", "children": [{"type": "x"}]}}',
            r"tree.children\[0\] has no known",
        ),
        ('{"grammarbt": 1, "tree": {"type": "action"}}', "tree needs a .name."),
        ('{"grammarbt": 1, "tree": {"type": "action", "name": "a(b"}}', "cannot have the name"),
        ('{"grammarbt": 1, "tree": {"type": "action", "name": "a", "arguments": {"x": 1}}}', "not a string"),
        ('{"grammarbt": 1, "tree": {"type": "parallel", "children": []}}', "without a number"),
        ('{"grammarbt": 1, "tree": {"type": "sequence", "children": []}}', "needs children, at tree"),
        ("9" * 5000, "not a tree in JSON"),
    ],
)
def test_an_error_in_json_names_the_place(text, says):
    with pytest.raises(FormatError, match=says):
        json_format.loads(text)


def test_py_trees_xml_says_what_it_cannot():
    with pytest.raises(FormatError, match=r"no parallel node like ours.*convert to py_trees"):
        py_trees_xml.dumps(MANUAL)
