"""Own the words' sounds: the model's dictionary and its gaps, cut down to the words in use.

A decoder prepares every search for every word that it knows, used or not: with all 135 000 each
start took a second of a processor more. Pure but for reading the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

_MORE = (
    "settee S EH T IY",
    "bathroom(2) B AA TH R UW M",
    "corridor(3) K AO R IH D AO",
)
"""What the American dictionary lacks or Britons say otherwise. Not "bath":
with their vowel it is too near "dock", and an order to the dock went to the bath."""


class Dictionary:
    """Know which words can be said, and how."""

    def __init__(self, path: Path) -> None:
        """Read a dictionary: on each line a word, a space and its sounds (CMUdict's form).

        Raises:
            OSError: there is none.
        """
        lines = (*path.read_text("utf-8").splitlines(), *_MORE)
        self._lines = {line.partition(" ")[0]: line for line in lines}

    def __contains__(self, word: str) -> bool:
        """Tell whether a word can be said."""
        return word in self._lines

    def cut(self, words: Iterable[str]) -> str:
        """Return a dictionary of those of the words that it knows, each in all the ways it has."""
        return "".join(f"{line}\n" for word in sorted(set(words)) for line in self._ways(word))

    def _ways(self, word: str) -> Iterator[str]:
        said, way = word, 1
        while said in self._lines:
            yield self._lines[said]
            way += 1
            said = f"{word}({way})"
