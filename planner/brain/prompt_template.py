"""Read versioned prompt templates ``prompts/*.md``, each with its version in the first line."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from planner.brain.schema import Message
from wire import ConfigError

SHOWN = 2000
"""Characters of a bad reply that are shown to the model again."""
_VERSION = re.compile(r"version: ([0-9]{1,4})\n\n")
_BLANK = re.compile(r"\{\{(\w+)\}\}")


@dataclass(frozen=True)
class Template:
    """Be one version of one prompt; ``tag`` names it in a goal's record."""

    name: str
    version: int
    text: str
    fingerprint: str

    @classmethod
    def load(cls, path: Path, blanks: frozenset[str]) -> Template:
        """Read a template.

        Raises:
            ConfigError: ``prompt_missing``; ``prompt_malformed``: no version line, or blanks that
                nobody fills.
        """
        try:
            text = path.read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ConfigError("prompt_missing", f"{path}: {type(error).__name__}") from None
        found = _VERSION.match(text)
        if found is None:
            raise ConfigError("prompt_malformed", f"{path} must begin with 'version: N'")
        here = set(_BLANK.findall(text))
        if here != blanks:
            wrong = ", ".join(sorted(here ^ blanks))
            raise ConfigError("prompt_malformed", f"{path}: unknown or missing blanks: {wrong}")
        digest = hashlib.sha256(text.encode()).hexdigest()[:12]
        return cls(path.stem, int(found[1]), text[found.end() :], digest)

    @property
    def tag(self) -> str:
        """Return name, version and hash in a word."""
        return f"{self.name}/{self.version}@{self.fingerprint}"

    def fill(self, **words: str) -> str:
        """Return the text with its blanks filled."""
        return _BLANK.sub(lambda blank: words[blank[1]], self.text).strip()


def repair(reply: str, reasons: Sequence[str]) -> list[Message]:
    """Return the messages that follow an unusable reply."""
    asked = {"not_usable_because": list(reasons), "now": "reply with one correct JSON object"}
    return [
        {"role": "assistant", "content": reply[:SHOWN] or "(nothing)"},
        {"role": "user", "content": as_json(asked)},
    ]


def as_json(value: object) -> str:
    """Return data as it enters a prompt."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))
