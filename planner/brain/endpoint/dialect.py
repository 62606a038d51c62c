"""Own what one server and model understands: the rung of the ladder and a few parameters.

The dialect is found out at the first call, by use and not by a call of its own: a server that
answers 400 is asked again in the next simpler way. What it took is kept in the home folder. The
schema's text is always in the prompt, tools and response_format never go together, and whatever
comes back is judged here: a looser rung costs quality, never safety.
"""

from __future__ import annotations

import hashlib
import json
import logging
import re
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal

from planner.brain.schema import NAME, Message
from planner.settings import Mode, ModelSettings

log = logging.getLogger(__name__)

FILE = "model_dialects.json"
MAX_BYTES = 256 * 1024
MAX_KEPT = 50
LADDER = tuple(Mode)
"""Strictest first."""

Body = dict[str, Any]
TokensField = Literal["max_tokens", "max_completion_tokens"]


@dataclass(frozen=True, slots=True)
class Dialect:
    """Say how to ask. ``fixed``: the owner chose the mode, so it is not stepped down from."""

    mode: Mode = LADDER[0]
    temperature: bool = True
    system: bool = True
    tokens_field: TokensField = "max_tokens"
    fixed: bool = False

    def simpler(self, complaint: str) -> Dialect | None:
        """Return the next dialect to try after a 400 with these words, or None.

        A parameter is given up where the complaint names it; else the ladder is stepped down.
        """
        if self.temperature and "temperature" in complaint:
            return replace(self, temperature=False)
        if self.tokens_field == "max_tokens" and "max_completion_tokens" in complaint:
            return replace(self, tokens_field="max_completion_tokens")
        if self.system and _about_system(complaint):
            return replace(self, system=False)
        below = LADDER[LADDER.index(self.mode) + 1 :]
        return replace(self, mode=below[0]) if below and not self.fixed else None


def _about_system(complaint: str) -> bool:
    return "role" in complaint and re.search(r"\bsystem\b", complaint) is not None


def body_of(
    settings: ModelSettings, dialect: Dialect, messages: list[Message], schema: Body
) -> Body:
    """Return the body of one call."""
    body: Body = {
        "model": settings.name,
        "messages": messages if dialect.system else _merged(messages),
        "stream": False,
        dialect.tokens_field: settings.max_tokens,
    }
    if dialect.temperature and settings.temperature is not None:
        body["temperature"] = settings.temperature
    body.update(_MODES[dialect.mode](schema))
    return body


def _merged(messages: list[Message]) -> list[Message]:
    """Put the system's words before the person's, for models that know no system role."""
    system, first, *rest = messages
    both = f"{system['content']}\n\n{first['content']}"
    return [{"role": "user", "content": both}, *rest]


def _json_schema(schema: Body) -> Body:
    # Not strict: OpenAI's strict mode wants every field of every step, which costs tokens.
    described = {"name": NAME, "schema": schema, "strict": False}
    return {"response_format": {"type": "json_schema", "json_schema": described}}


_MODES: dict[Mode, Callable[[Body], Body]] = {
    Mode.JSON_SCHEMA: _json_schema,
    Mode.PROMPT: lambda _schema: {},
}


class Dialects:
    """Remember dialects in a file of the home folder; one that can't be read is found out anew."""

    def __init__(self, home: Path, settings: ModelSettings, url: str) -> None:
        self._path = home / FILE
        self._key = hashlib.sha256(f"{url}\n{settings.name}".encode()).hexdigest()[:24]
        self._fixed = settings.mode
        known = self._all().get(self._key)
        self._kept = isinstance(known, dict)
        dialect = _dialect(known) if isinstance(known, dict) else Dialect()
        if self._fixed:
            dialect = replace(dialect, mode=self._fixed, fixed=True)
        self._now = dialect

    @property
    def now(self) -> Dialect:
        """Return how to ask."""
        return self._now

    def keep(self, dialect: Dialect) -> None:
        """Remember what the server took. A disk that refuses costs a call at the next start."""
        if dialect == self._now and self._kept:
            return
        self._now, self._kept = dialect, True
        kept = {k: v for k, v in self._all().items() if k != self._key}
        kept = dict([*kept.items()][-(MAX_KEPT - 1) :])
        kept[self._key] = asdict(replace(dialect, fixed=False))
        fresh = self._path.with_suffix(".new")
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            fresh.write_text(json.dumps(kept, indent=1) + "\n", "utf-8")
            fresh.replace(self._path)
        except OSError as error:
            log.warning("%s could not be written: %s", self._path, error.strerror)

    def _all(self) -> dict[str, Any]:
        try:
            with self._path.open("rb") as file:
                found = json.loads(file.read(MAX_BYTES))
        except (OSError, ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


def _dialect(known: dict[str, Any]) -> Dialect:
    try:
        return Dialect(
            mode=Mode(known.get("mode", LADDER[0])),
            temperature=known.get("temperature") is not False,
            system=known.get("system") is not False,
            tokens_field="max_completion_tokens"
            if known.get("tokens_field") == "max_completion_tokens"
            else "max_tokens",
        )
    except ValueError:
        return Dialect()
