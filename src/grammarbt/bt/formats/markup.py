"""XML in: a small tree of elements, with everything that could hurt refused.

Document types are refused whole, so there are no entities to expand and nothing to fetch.
"""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING
from xml.parsers import expat

from attrs import define, field, frozen

from grammarbt.bt.model import MAX_DEPTH
from grammarbt.errors import FormatError

if TYPE_CHECKING:
    from typing import NoReturn

MAX_NESTING = MAX_DEPTH + 8
"""Elements around the deepest element; those of the deepest tree and of its surroundings."""


@frozen
class Element:
    """An element; text between elements is dropped.

    Attributes:
        tag: its name.
        attributes: its attributes.
        children: the elements inside.
        line: where it starts, from 1.
    """

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(factory=list)

    @property
    def place(self) -> str:
        """For errors."""
        return f"at <{self.tag}> in line {self.line}"


def read_xml(text: str) -> Element:
    """Read a document; gives its root element.

    Raises:
        FormatError: it is not well-formed XML, has a document type, or is nested deeper than `MAX_NESTING`.
    """
    reader = _Reader()
    try:
        reader.parser.ParseFile(BytesIO(text.encode()))
    except expat.ExpatError as error:
        message = expat.ErrorString(error.code)
        raise FormatError(
            f"not XML: {message}, line {error.lineno} column {error.offset + 1}", "check the file"
        ) from None
    except UnicodeError:
        raise FormatError("not XML: the text holds characters that no file can hold", "check the file") from None
    return reader.top.children[0]


def quoted(value: str) -> str:
    """An attribute's value, quoted and escaped."""
    for character, entity in (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ('"', "&quot;")):
        value = value.replace(character, entity)
    return f'"{value}"'


@define
class _Reader:
    top: Element = field(factory=lambda: Element("", {}, 0))
    parser: expat.XMLParserType = field(factory=lambda: expat.ParserCreate("utf-8"))
    open: list[Element] = field(factory=list)

    def __attrs_post_init__(self) -> None:
        self.open.append(self.top)
        self.parser.StartDoctypeDeclHandler = self.refuse_document_type
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end

    def refuse_document_type(self, *_: object) -> NoReturn:
        raise FormatError("the XML declares a document type, which trees do not need", "remove <!DOCTYPE …>")

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        if len(self.open) > MAX_NESTING:
            raise FormatError(f"the XML is nested deeper than {MAX_NESTING} elements", "flatten the tree")
        element = Element(tag, attributes, self.parser.CurrentLineNumber)
        self.open[-1].children.append(element)
        self.open.append(element)

    def end(self, _: str) -> None:
        self.open.pop()
