"""Estimate the tokens of a prompt, rather too many than too few. Knows no tokenizer.

Common tokenizers make one of a short word, of three digits, of a few marks in a row and, at the
worst, of each Chinese character.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import CHINESE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.brain.schema import Message

_PIECE = re.compile(rf"([A-Za-z]+)|[0-9]{{1,3}}|[{CHINESE}]|[^\sA-Za-z0-9{CHINESE}]{{1,3}}")
_LETTERS = 8
PICTURE_TOKENS = 1500
"""Counted for a picture before the server says what it billed, rather too many: with a long side of
1024 tiles of 512 px cost 765, patches of 28 or 32 px 1 369 or 1 024, an area by 750 1 398."""


def tokens(messages: Sequence[Message]) -> int:
    """Estimate the tokens of messages."""
    return sum(map(count_tokens, (message["content"] for message in messages)))


def count_tokens(text: str) -> int:
    """Estimate the tokens of a text."""
    return sum(1 + max(0, len(piece[1] or "") - 1) // _LETTERS for piece in _PIECE.finditer(text))


def cut_tokens(text: str, most: int) -> str:
    """Return as much of a text's beginning as that many tokens hold."""
    spent = 0
    for piece in _PIECE.finditer(text):
        spent += count_tokens(piece[0])
        if spent > most:
            return f"{text[: piece.start()].rstrip()} …"
    return text
