"""Render the prompt: the only place where words for a model are put together.

`prompts/plan.md` is the template; its first line is its version. Names of places and the person's
words enter as JSON, as data only.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from planner.brain.protocol import ThinkRequest
from planner.brain.schema import (
    CLARIFY_CODES,
    REFUSE_CODES,
    Message,
    schema_of,
    step_line,
    step_models,
)
from planner.plan import Code, Vocabulary
from wire import Misconfigured

FOLDER = Path(__file__).resolve().parents[2] / "prompts"
CHARACTERS_PER_TOKEN = 4
_VERSION = re.compile(r"version: ([0-9]{1,4})\n\n")
_BLANK = re.compile(r"\{\{(\w+)\}\}")
_BLANKS = frozenset({"steps", "clarify", "refuse", "places", "schema"})
_NAMES = 16  # of one place: more would crowd out the other places
_SHOWN = 2000  # characters of a bad reply that are shown to the model again


@dataclass(frozen=True)
class Prompt:
    """Be one version of the prompt; `tag` names it in a goal's record."""

    version: int
    template: str
    fingerprint: str

    @classmethod
    def load(cls, path: Path = FOLDER / "plan.md") -> Prompt:
        """Read a template.

        Raises:
            Misconfigured: ``prompt_missing``; ``prompt_malformed``: no version line, or blanks that
                nobody fills.
        """
        try:
            text = path.read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise Misconfigured("prompt_missing", f"{path}: {type(error).__name__}") from None
        found = _VERSION.match(text)
        if found is None:
            raise Misconfigured("prompt_malformed", f"{path} must begin with 'version: N'")
        blanks = set(_BLANK.findall(text))
        if blanks != _BLANKS:
            wrong = ", ".join(sorted(blanks ^ _BLANKS))
            raise Misconfigured("prompt_malformed", f"{path}: unknown or missing blanks: {wrong}")
        digest = hashlib.sha256(text.encode()).hexdigest()[:12]
        return cls(int(found[1]), text[found.end() :], digest)

    @property
    def tag(self) -> str:
        """Return version and hash in a word."""
        return f"plan/{self.version}@{self.fingerprint}"

    def messages(self, request: ThinkRequest) -> list[Message]:
        """Return the messages of a first call: one of the system, one of the person."""
        order: dict[str, str] = {"order": request.text}
        if request.room is not None:
            order["robot_is_in"] = request.room
        if request.language is not None:
            order["language"] = request.language.value
        return [
            {"role": "system", "content": _system(self.template, request.vocabulary)},
            {"role": "user", "content": _json(order)},
        ]

    def repair(self, reply: str, reasons: Sequence[str]) -> list[Message]:
        """Return the messages that follow an unusable reply."""
        asked = {"not_usable_because": list(reasons), "now": "reply with one correct JSON object"}
        return [
            {"role": "assistant", "content": reply[:_SHOWN] or "(nothing)"},
            {"role": "user", "content": _json(asked)},
        ]


def tokens(messages: Sequence[Message]) -> int:
    """Estimate the tokens of messages, at four characters each."""
    return sum(len(message["content"]) for message in messages) // CHARACTERS_PER_TOKEN


@lru_cache(maxsize=16)
def _system(template: str, vocabulary: Vocabulary) -> str:
    filled = {
        "steps": "\n".join(map(step_line, step_models().values())),
        "clarify": _codes(CLARIFY_CODES),
        "refuse": _codes(REFUSE_CODES),
        "places": "\n".join(_place_lines(vocabulary)),
        "schema": _json(schema_of(vocabulary)),
    }
    return _BLANK.sub(lambda blank: filled[blank[1]], template).strip()


def _place_lines(vocabulary: Vocabulary) -> list[str]:
    return [
        f"{entry.id}: {_json([entry.name.en, entry.name.zh, *entry.aliases][:_NAMES])}"
        for entry in vocabulary.entries
    ]


def _codes(codes: Sequence[Code]) -> str:
    return ", ".join(code.value for code in codes)


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))
