"""Whatever a text holds, it stays a text."""

import json
from html.parser import HTMLParser

from hypothesis import given
from hypothesis import strategies as st

from grammarbt.report.markup import data, element, page, table

SCRIPT = "<script>alert(1)</script>"
TEXTS = st.text(st.characters(exclude_categories=["Cs", "Cc"])) | st.just(SCRIPT) | st.just("]]></script><!--")


class Seen(HTMLParser):
    """The tags and the text of a page."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.text, self.attributes = [], "", []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs

    def handle_data(self, data):
        self.text += data


@given(TEXTS, TEXTS)
def test_an_element_gives_back_its_text_and_its_attributes(text, label):
    seen = Seen(element("p", text, aria_label=label))
    assert (seen.tags, seen.text, seen.attributes) == (["p"], text, [("aria-label", label)])


@given(st.recursive(TEXTS | st.integers(), lambda inner: st.lists(inner) | st.dictionaries(TEXTS, inner)))
def test_no_text_ends_the_script_that_holds_json(value):
    seen = Seen(data("episode", value))
    assert seen.tags == ["script"]
    assert json.loads(seen.text) == value


def test_cells_captions_and_titles_are_escaped():
    html = page(SCRIPT, (), table(SCRIPT, (SCRIPT,), [(SCRIPT,)]))
    assert "script" not in Seen(html).tags
    assert Seen(html).text.count(SCRIPT) == 4
