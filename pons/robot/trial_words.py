"""Say what ``pons robot try`` asks of a person and what it found, in English and Chinese."""

from __future__ import annotations

from typing import Final

from bridge.drive.base_trouble import BASE_TROUBLES
from devices import PORT_CURES
from pons.command_words import load_words

WORDS: Final = load_words("pons.robot")
PROMPTS: Final = WORDS["prompts"]
"""By what is asked."""
STEPS: Final = WORDS["steps"]
"""By step, in order; the engine tells them, a person reads them."""
REFUSALS: Final = {**WORDS["refusals"], **PORT_CURES, **BASE_TROUBLES}
"""By code; each is preceded by what came."""
