"""Name why a calibration ends without a result: a stable code, the remedy."""

from __future__ import annotations

from pons.command_words import load_words
from pons.terminal import pick

WORDS = load_words("pons.calibrate")["refusals"]


class CalibrationRefusal(Exception):
    """End a calibration; the robot stands and nothing was written."""

    def __init__(self, code: str, detail: str = "") -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail

    def lines(self) -> list[str]:
        """Return the text for a person."""
        head = f"{self.code}: {self.detail}" if self.detail else self.code
        return [head, f"  {pick(*WORDS[self.code])}"]


class RunLost(Exception):
    """One run is worth nothing; another may be."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail
