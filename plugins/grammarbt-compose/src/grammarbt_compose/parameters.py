"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from attrs import field, frozen, validators

from grammarbt.search import ClimbParameters


@frozen
class ComposeParameters(ClimbParameters):
    """How to compose."""

    largest_block: int = field(
        default=20_000,
        validator=validators.ge(1),
        metadata={"help": "words of a group's sub-tree up to which they are listed; larger groups are sampled"},
    )
