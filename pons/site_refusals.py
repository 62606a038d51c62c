"""Refuse an act on a site in the catalogue's words, whole in each language. Knows no files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from maps import SiteError
from planner.language.catalogue import say
from planner.plan import Bilingual

if TYPE_CHECKING:
    from pathlib import Path

    from bridge.recording.recording_reader import BadRecording


def site_refusal(
    code: str, told: str | None = None, /, **facts: Bilingual | str | float
) -> SiteError:
    """Return a refusal in the words of the catalogue's ``site_refusal``; None: the code's own."""
    words = say(f"site_refusal.{told or code}", **facts)
    return SiteError(code, words.en, words.zh)


def keyframes_malformed(path: Path, error: Exception) -> SiteError:
    """Return the refusal of kept keyframes that can't be read."""
    facts = {"path": str(path), "why": str(error)}
    return site_refusal("keyframes_malformed", **facts)


def recording_refused(path: Path, error: BadRecording) -> SiteError:
    """Return the refusal of a recording that can't be read."""
    particulars = error.detail.removeprefix(str(path)).lstrip(":, ")
    why = Bilingual(en=particulars, zh=say(f"recording_refusal.{error.code}").zh)
    return site_refusal(error.code, "recording", path=str(path), why=why)
