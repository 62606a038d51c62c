"""Own what one server and model understands: the rung of the ladder and a few parameters.

The dialect is found out at the first call, by use and not by a call of its own: a server that
answers 400 is asked again in the next simpler way. The schema's text is always in the prompt, tools
and response_format never go together, and whatever comes back is judged here: a looser rung costs
quality, never safety. Pure; `dialects` remembers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from planner.brain.endpoint.image_content import attached
from planner.brain.response_format import PLAN_FORM, Form
from planner.brain.schema import Message
from planner.settings import Mode, ModelSettings, TokensField

LADDER = tuple(Mode)
"""Strictest first."""

Body = dict[str, Any]
_TOO_LONG = re.compile(r"context (?:length|window|size)|maximum context|prompt is too long")


@dataclass(frozen=True, slots=True)
class Dialect:
    """Say how to ask. ``fixed``: the owner chose the mode, so it is not stepped down from."""

    mode: Mode = LADDER[0]
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
        known = settings.known
        begin = cls() if known is None else cls(
            mode=known.mode, system=known.system, tokens_field=known.tokens_field
        )  # fmt: skip
        if settings.mode is not None:
            begin = replace(begin, mode=settings.mode, fixed=True)
        return begin

    def simpler(self, complaint: str, quiet: frozenset[str] = frozenset()) -> Iterator[Dialect]:
        """Yield what to try after a 400 with these words, the likeliest first.

        A parameter is given up where the complaint names it; else the ladder is stepped down.

        Args:
            complaint: the server's words, in small letters.
            quiet: the fields that switch thoughts off here.
        """
        if _TOO_LONG.search(complaint):
            return  # a shorter way of asking would pass for once, and be remembered for all
        if self.temperature and "temperature" in complaint:
            yield replace(self, temperature=False)
        if "max_completion_tokens" in complaint or "max_tokens" in complaint:
            yield replace(self, tokens_field=_other(self.tokens_field))
        if self.usage and ("stream_options" in complaint or "include_usage" in complaint):
            yield replace(self, usage=False)
        if self.quiet and any(name.lower() in complaint for name in quiet):
            yield replace(self, quiet=False)
        if self.stream and re.search(r"\bstream(?:ing|ed)?\b", complaint):
            yield replace(self, stream=False)
        if self.system and _about_system(complaint):
            yield replace(self, system=False)
        if not self.fixed:
            yield from (replace(self, mode=mode) for mode in LADDER[LADDER.index(self.mode) + 1 :])


def _other(tokens_field: TokensField) -> TokensField:
    return "max_completion_tokens" if tokens_field == "max_tokens" else "max_tokens"


def _about_system(complaint: str) -> bool:
    return "role" in complaint and re.search(r"\bsystem\b", complaint) is not None


def quiet_of(settings: ModelSettings) -> Body:
    """Return what switches this server's thoughts off, as far as it is wanted and known."""
    known = settings.known
    return {} if known is None or settings.thinking else dict(known.quiet)


def body_of(
    settings: ModelSettings,
    dialect: Dialect,
    messages: list[Message],
    schema: Body,
    *,
    stream: bool = False,
    form: Form = PLAN_FORM,
    picture: str | None = None,
) -> Body:
    """Return the body of one call; what Pons writes itself wins over all that is extra.

    Args:
        settings: of the model.
        dialect: how to ask.
        messages: words alone.
        schema: of the reply.
        stream: ask for the reply while it is written.
        form: what the reply is called.
        picture: the data URL of the picture that goes with the person's first words.
    """
    said = messages if dialect.system else _merged(messages)
    body: Body = quiet_of(settings) if dialect.quiet else {}
    body |= settings.extra_body
    body |= {
        "model": settings.name,
        "messages": said if picture is None else attached(said, picture),
        "stream": stream and dialect.stream,
        dialect.tokens_field: settings.max_tokens,
    }
    if stream and dialect.stream and dialect.usage:
        body["stream_options"] = {"include_usage": True}
    if dialect.temperature and settings.temperature is not None:
        body["temperature"] = settings.temperature
    return body | _MODES[dialect.mode](schema, form)


def _merged(messages: list[Message]) -> list[Message]:
    """Put the system's words before the person's, for models that know no system role."""
    system, first, *rest = messages
    both = f"{system['content']}\n\n{first['content']}"
    return [{"role": "user", "content": both}, *rest]


def _json_schema(schema: Body, form: Form) -> Body:
    # Not strict: OpenAI's strict mode wants every field of every step, which costs tokens.
    described = {"name": form.name, "schema": schema, "strict": False}
    return {"response_format": {"type": "json_schema", "json_schema": described}}


def _tool(schema: Body, form: Form) -> Body:
    function = {"name": form.name, "description": form.told, "parameters": schema}
    return {
        "tools": [{"type": "function", "function": function}],
        "tool_choice": {"type": "function", "function": {"name": form.name}},
    }


_MODES: dict[Mode, Callable[[Body, Form], Body]] = {
    Mode.JSON_SCHEMA: _json_schema,
    Mode.TOOL: _tool,
    Mode.JSON_OBJECT: lambda _schema, _form: {"response_format": {"type": "json_object"}},
    Mode.PROMPT: lambda _schema, _form: {},
}
