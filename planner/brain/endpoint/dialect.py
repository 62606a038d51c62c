"""Own what one server and model understands: the rung of the ladder, a few parameters, pictures.

The dialect is found out at the first call, by use and not by a call of its own: a server that
answers 400 is asked again in the next simpler way. The schema goes as response_format or
as a tool, and into the prompt's text where neither is taken; tools and response_format never go
together, and whatever comes back is judged in `plan_reply`: a looser
rung costs quality, never safety. `Dialects` remembers in a file of the home folder; what can't be
read there is found out anew.

Sources of the words about pictures, read in November 2026: llama.cpp answers 500 "image input is
not supported", vLLM 500 or 400, Ollama 400 "this model does not support image input", OpenAI 400
"image_url is only supported by certain models", DeepSeek 400 or 422 "unknown variant `image_url`,
expected `text`", routers 404 "no endpoints found that support image input".
"""

from __future__ import annotations

import base64
import hashlib
import json
import logging
import re
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from planner.brain.endpoint.completion import is_too_long
from planner.brain.response_format import PLAN_FORM, ReplyForm
from planner.brain.schema import Message
from planner.settings import JsonMode, ModelSettings, TokensField

MAX_JPEG_BYTES = 500_000
"""Twice what 1024 pixels take; to pack more would hold the event loop for over 10 ms."""
_NOT_TAKEN = re.compile(
    r"image[ _]?(?:input|url|content)s?\b.{0,60}(?:not supported|unsupported|only supported)"
    r"|(?:not|n't|found that) support.{0,30}\b(?:images?|vision|multi-?modal)"
    r"|unsupported content part|unknown variant.{0,4}image_url|not a multi-?modal model|mmproj"
    r"|missing data required for image|at most 0 image"
)
_THIS_ONE = re.compile(
    r"(?:invalid|corrupt|malformed|decode|process|load).{0,30}\bimage|base64"
    r"|\bimage\b.{0,40}(?:invalid|corrupt|too large|too small|exceed|decoded?)"
)
_AT_ALL = re.compile(
    r"\bimages?\b|image_url|vision|multi-?modal"
    r"|content.{0,60}\b(?:string|text)\b|\b(?:string|text)\b.{0,60}content"
)
_THE_WAY = re.compile(
    r"response_format|json_|tool_choice|\btools?\b|temperature|max_\w*tokens|too long|context"
)


def data_url(jpeg: bytes) -> str:
    """Return a picture as a URL that holds it."""
    return f"data:image/jpeg;base64,{base64.b64encode(jpeg).decode('ascii')}"


def attach_picture(messages: list[Message], url: str) -> list[dict[str, Any]]:
    """Return the messages with the picture in the person's first one, behind its words."""
    sent: list[dict[str, Any]] = [{str(k): v for k, v in each.items()} for each in messages]
    first = next(message for message in sent if message["role"] == "user")
    words = {"type": "text", "text": first["content"]}
    first["content"] = [words, {"type": "image_url", "image_url": {"url": url}}]
    return sent


def not_taken(said: str) -> bool:
    """Tell whether a server's words, in small letters, are plainly that it takes no pictures."""
    return _NOT_TAKEN.search(said) is not None


def why_refused(said: str) -> str | None:
    """Return why a body with a picture was refused, or None where another way of asking may do.

    Args:
        said: the server's words, in small letters.
    """
    if not_taken(said):
        return "no_pictures"
    if _THIS_ONE.search(said):
        return "bad_picture"
    return "no_pictures" if _AT_ALL.search(said) and not _THE_WAY.search(said) else None


LADDER = tuple(JsonMode)
"""Strictest first."""

Body = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Dialect:
    """Say how to ask. ``fixed``: the owner chose the mode, so it is not stepped down from."""

    mode: JsonMode = LADDER[0]
    temperature: bool = True
    system: bool = True
    tokens_field: TokensField = "max_tokens"
    quiet: bool = True
    """Send what switches the model's thoughts off."""
    stream: bool = True
    usage: bool = True
    """Ask a stream for what it cost."""
    pictures: bool | None = None
    """It takes pictures; None: nobody knows yet."""
    fixed: bool = False

    @classmethod
    def first(cls, settings: ModelSettings) -> Dialect:
        """Return how a server is asked of which nothing but its preset is known."""
        known = settings.known_preset
        begin = cls() if known is None else cls(
            mode=known.mode, system=known.system, tokens_field=known.tokens_field
        )  # fmt: skip
        if settings.mode is not None:
            begin = replace(begin, mode=settings.mode, fixed=True)
        return begin

    def simpler(self, complaint: str, quiet: frozenset[str] = frozenset()) -> Iterator[Dialect]:
        """Yield the dialects to try after a 400 with these words, the likeliest first.

        A parameter is given up where the complaint names it; else the ladder is stepped down.

        Args:
            complaint: the server's words, in small letters.
            quiet: the fields that switch thoughts off here.
        """
        if is_too_long(complaint):
            return  # a shorter way of asking would pass for once, and be remembered for all
        if self.temperature and "temperature" in complaint:
            yield replace(self, temperature=False)
        if "max_completion_tokens" in complaint or "max_tokens" in complaint:
            yield replace(self, tokens_field=_swap_field(self.tokens_field))
        if self.usage and ("stream_options" in complaint or "include_usage" in complaint):
            yield replace(self, usage=False)
        if self.quiet and any(name.lower() in complaint for name in quiet):
            yield replace(self, quiet=False)
        if self.stream and re.search(r"\bstream(?:ing|ed)?\b", complaint):
            yield replace(self, stream=False)
        if self.system and _about_system(complaint):
            yield replace(self, system=False)
        yield from self.lower()

    def lower(self) -> Iterator[Dialect]:
        """Yield the rungs below, the strictest first; none where the owner chose the mode."""
        if not self.fixed:
            yield from (replace(self, mode=mode) for mode in LADDER[LADDER.index(self.mode) + 1 :])


def _swap_field(tokens_field: TokensField) -> TokensField:
    return "max_completion_tokens" if tokens_field == "max_tokens" else "max_tokens"


def _about_system(complaint: str) -> bool:
    return "role" in complaint and re.search(r"\bsystem\b", complaint) is not None


def quiet_of(settings: ModelSettings) -> Body:
    """Return the fields that switch this server's thoughts off, as far as wanted and known."""
    known = settings.known_preset
    return {} if known is None or settings.thinking else dict(known.quiet)


def body_of(
    settings: ModelSettings,
    dialect: Dialect,
    messages: list[Message],
    schema: Body,
    *,
    stream: bool = False,
    form: ReplyForm = PLAN_FORM,
    picture: str | None = None,
) -> Body:
    """Return the body of one call; fields that Pons writes itself win over extra ones.

    Args:
        settings: of the model.
        dialect: how to ask.
        messages: words alone.
        schema: of the reply.
        stream: ask for the reply while it is written.
        form: what the reply is called.
        picture: the data URL of the picture that goes with the person's first words.
    """
    if not form.prompt_has_schema and dialect.mode in _LOOSE:
        messages = _add_schema(messages, schema)
    said = messages if dialect.system else _merge_system(messages)
    body: Body = quiet_of(settings) if dialect.quiet else {}
    body |= settings.extra_body
    body |= {
        "model": settings.name,
        "messages": said if picture is None else attach_picture(said, picture),
        "stream": stream and dialect.stream,
        dialect.tokens_field: settings.max_tokens,
    }
    if stream and dialect.stream and dialect.usage:
        body["stream_options"] = {"include_usage": True}
    if dialect.temperature and settings.temperature is not None:
        body["temperature"] = settings.temperature
    return body | _MODES[dialect.mode](schema, form)


_LOOSE = frozenset({JsonMode.JSON_OBJECT, JsonMode.PROMPT})
"""Ways of asking in which the server is given no schema."""


def _add_schema(messages: list[Message], schema: Body) -> list[Message]:
    """Write the schema behind the system's words."""
    system, *rest = messages
    written = json.dumps(schema, ensure_ascii=False, separators=(",", ":"))
    told = f"{system['content']}\n\nThe reply fits this JSON schema:\n{written}"
    return [{"role": system["role"], "content": told}, *rest]


def _merge_system(messages: list[Message]) -> list[Message]:
    """Put the system's words before the person's, for models that know no system role."""
    system, first, *rest = messages
    both = f"{system['content']}\n\n{first['content']}"
    return [{"role": "user", "content": both}, *rest]


def _json_schema(schema: Body, form: ReplyForm) -> Body:
    # Not strict: OpenAI's strict mode wants every field of every step, which costs tokens.
    described = {"name": form.name, "schema": schema, "strict": False}
    return {"response_format": {"type": "json_schema", "json_schema": described}}


def _tool(schema: Body, form: ReplyForm) -> Body:
    function = {"name": form.name, "description": form.told, "parameters": schema}
    return {
        "tools": [{"type": "function", "function": function}],
        "tool_choice": {"type": "function", "function": {"name": form.name}},
    }


_MODES: dict[JsonMode, Callable[[Body, ReplyForm], Body]] = {
    JsonMode.JSON_SCHEMA: _json_schema,
    JsonMode.TOOL: _tool,
    JsonMode.JSON_OBJECT: lambda _schema, _form: {"response_format": {"type": "json_object"}},
    JsonMode.PROMPT: lambda _schema, _form: {},
}


log = logging.getLogger(__name__)

FILE = "model_dialects.json"
MAX_BYTES = 256 * 1024
MAX_KEPT = 50
CLIMB_S = 86_400.0
"""After so long a server is asked from the first rung again: it may have been updated."""
BARREN_CLIMB_S = 3_600.0
"""The same, where a rung was taken and brought nothing: the model may have been at fault, once."""
_SHAPE = TypeAdapter(Dialect)


class Dialects:
    """Hold the dialect of one URL and model."""

    def __init__(self, home: Path, settings: ModelSettings, url: str) -> None:
        self._path = home / FILE
        self._key = hashlib.sha256(f"{url}\n{settings.name}".encode()).hexdigest()[:24]
        first = Dialect.first(settings)
        row = self._load().get(self._key)
        known, self._climbed_unix_s = _known_dialect(row), _climbed_unix_s(row)
        self._first_mode = first.mode
        self.kept = known is not None
        """The server is known to have taken this."""
        self._now = first if known is None else known
        if first.fixed:
            self._now = replace(self._now, mode=first.mode, fixed=True)

    @property
    def current(self) -> Dialect:
        """Return how to ask; what was found out a day ago is tried from the first rung again."""
        return replace(self._now, mode=self._first_mode) if self._may_climb() else self._now

    def _may_climb(self) -> bool:
        lower = LADDER.index(self._now.mode) > LADDER.index(self._first_mode)
        fresh = 0.0 <= time.time() - self._climbed_unix_s < CLIMB_S
        return self.kept and lower and not self._now.fixed and not fresh

    def keep(self, dialect: Dialect, *, barren: bool = False) -> None:
        """Remember what the server took. A disk that refuses costs a call at the next start.

        Args:
            dialect: what was taken.
            barren: a stricter way was taken as well and brought nothing.
        """
        climbed = not self.kept or barren or self._may_climb()
        if dialect == self._now and not climbed:
            return
        if climbed:
            self._climbed_unix_s = time.time() - (CLIMB_S - BARREN_CLIMB_S if barren else 0.0)
        self._now, self.kept = dialect, True
        kept = {k: v for k, v in self._load().items() if k != self._key}
        kept = dict([*kept.items()][-(MAX_KEPT - 1) :])
        row = asdict(replace(dialect, fixed=False))
        kept[self._key] = row | {"climbed_unix_s": self._climbed_unix_s}
        fresh = self._path.with_suffix(".new")
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            fresh.write_text(json.dumps(kept, indent=1) + "\n", "utf-8")
            fresh.replace(self._path)
        except OSError as error:
            log.warning("%s could not be written: %s", self._path, error.strerror)

    def _load(self) -> dict[str, Any]:
        try:
            with self._path.open("rb") as file:
                found = json.loads(file.read(MAX_BYTES))
        except (OSError, ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


def _climbed_unix_s(row: object) -> float:
    """Return when a server was last asked from the first rung; long ago where nothing says so."""
    said = row.get("climbed_unix_s") if isinstance(row, dict) else None
    return float(said) if isinstance(said, int | float) and not isinstance(said, bool) else 0.0


def _known_dialect(known: object) -> Dialect | None:
    try:
        return replace(_SHAPE.validate_python(known), fixed=False)
    except ValidationError:
        return None
