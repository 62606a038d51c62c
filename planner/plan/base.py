"""Own the two bases of every record here: frozen, closed models and text in both languages.

Knows pydantic and nothing else. Every number in a plan has bounds and none may be NaN or infinite.
"""

from __future__ import annotations

from enum import StrEnum

from pydantic import BaseModel, ConfigDict


class Frozen(BaseModel):
    """Refuse unknown fields, changes after birth, NaN and infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Language(StrEnum):
    """The languages in which a goal may be given and an outcome is told."""

    EN = "en"
    ZH = "zh"


class Bilingual(Frozen):
    """Hold one sentence or name in both languages."""

    en: str
    zh: str

    def of(self, language: str) -> str:
        """Return the text in the language asked for; English where it has none."""
        return self.zh if language == Language.ZH else self.en


def say_same(text: str) -> Bilingual:
    """Say the same words in both languages: names, and text that someone else wrote."""
    return Bilingual(en=text, zh=text)
