"""Say a code of the bridge in English and Chinese. Loads the core's tables: import it late."""

from __future__ import annotations

from bridge.core.faults.code_messages import SENTENCES, WANTS
from bridge.core.faults.fault_messages import WORDS
from pons.terminal import pick


def sentence(code: str) -> tuple[str, str] | None:
    """Return the sentence of a stop's cause, a fault or a refusal, which may be a row."""
    return WORDS.get(code.upper()) or SENTENCES.get(code)


def code_lines(code: str) -> list[str]:
    """Return the line to print below a cause, a fault or a refusal; none without words."""
    words = sentence(code)
    return [] if words is None else [f"  {pick(*words)}"]


def lack_lines(code: str) -> list[str]:
    """Return the lines to print below a thing waited for."""
    words = WANTS.get(code)
    return code_lines(code) if words is None else [f"  {pick(*words)}"]
