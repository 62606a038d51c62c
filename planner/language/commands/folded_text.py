"""Hold a sentence as it is matched and as it was written, so that a name keeps its letters."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FoldedText:
    """Hold a sentence twice: to match, and as it was written; character for character alike."""

    folded: str
    written: str

    def part(self, start: int, end: int) -> FoldedText:
        return FoldedText(self.folded[start:end], self.written[start:end])

    def strip(self, characters: str) -> FoldedText:
        start = len(self.folded) - len(self.folded.lstrip(characters))
        return self.part(start, max(start, len(self.folded.rstrip(characters))))
