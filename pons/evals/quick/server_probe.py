"""Find out what a model's server does, whatever its model knows: whether a schema binds, how fast.

A plan in the right shape proves nothing about the server, for the prompt describes the shape. So
the proof asks for words that the prompt does not tell and that nobody guesses: only a server that
keeps the model to the schema, or shows it to the model, brings them.
"""

from __future__ import annotations

import json
import secrets
from typing import TYPE_CHECKING, Any

from planner.brain import BadPlan, BrainDown, ThinkRequest
from planner.brain.endpoint.completion import ModelReply
from planner.brain.errors import StillLoading
from planner.brain.prompt import Prompt
from planner.brain.prompt_tokens import count_tokens
from planner.brain.response_format import ReplyForm
from planner.brain.schema import Message, schema_of
from planner.plan import EVERY_KIND
from pons.evals.quick.exam import QUESTIONS, WORLD, ServerPace

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.brain.endpoint.line import Line

_PROOF = ReplyForm("greeting", "Greet the person.")
_GREET: list[Message] = [
    {"role": "system", "content": "You are friendly and reply in one short sentence."},
    {"role": "user", "content": "Greet me."},
]
_LETTERS = "bcdfghjklmnpqrstvwxz"
FEWEST_TOKENS, SHORTEST_S = 8, 0.05
"""Below which a rate would be one of the network's packets."""


async def holds_schema(line: Line, goal: str) -> bool | None:
    """Return whether a server keeps its model to a schema; None where it gives no reply.

    Args:
        line: whose settings choose the way of asking.
        goal: whose budget pays.
    """
    word = "".join(secrets.choice(_LETTERS) for _ in range(8))
    allowed = {"word": {"type": "string", "enum": [word]}, "sure": {"type": "boolean"}}
    schema = {
        "type": "object",
        "properties": allowed,
        "required": [*allowed],
        "additionalProperties": False,
    }

    async def talk(end_s: float) -> ModelReply:
        return await line.asker.ask(_GREET, schema, end_s, None, form=_PROOF)

    try:
        reply = await line.turn(goal, talk, "word")
    except (BadPlan, BrainDown):
        return None
    return None if reply.cut else _is_word(reply.text, word)


def _is_word(text: str, word: str) -> bool:
    try:
        written = json.loads(text)
    except (ValueError, RecursionError):
        return False
    fits = isinstance(written, dict) and written.keys() == {"word", "sure"}
    return fits and written["word"] == word and isinstance(written["sure"], bool)


async def measure_speed(
    line: Line, goal: str, clock: Callable[[], float], slow: Callable[[], None]
) -> ServerPace:
    """Return the server's pace over two orders; the first waits for a model to be loaded.

    Args:
        line: to the server, unused so far.
        goal: whose budget pays.
        clock: seconds that only rise.
        slow: is called where the first word takes long.
    """
    prompt, schema = Prompt.load(), schema_of(WORLD, EVERY_KIND)
    calls = []
    for question in QUESTIONS[:2]:
        request = ThinkRequest(
            text=question.text, vocabulary=WORLD, language=question.language, runnable=EVERY_KIND
        )
        call = _CallTimer(clock)
        try:
            await _wait_for(line, goal, prompt.messages(request), schema, call, slow)
        except (BadPlan, BrainDown):
            break
        calls.append(call)
    written, took_s = sum(call.tokens for call in calls), sum(call.writing_s for call in calls)
    fair = written >= FEWEST_TOKENS and took_s >= SHORTEST_S
    first_words = [call.first_word_s for call in calls] + [None, None]
    return ServerPace(first_words[0], first_words[1], written / took_s if fair else None)


async def _wait_for(
    line: Line,
    goal: str,
    messages: list[Message],
    schema: dict[str, Any],
    call: _CallTimer,
    slow: Callable[[], None],
) -> None:
    async def talk(end_s: float) -> ModelReply:
        return await line.asker.ask(messages, schema, end_s, call.hear)

    try:
        call.end(await line.turn(goal, talk, "word", slow))
    except StillLoading as loading:
        call.end(await loading.later())


class _CallTimer:
    """Time one call: its first word, and what was written after it."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock, self._began_s = clock, clock()
        self._heard_s: float | None = None
        self._ended_s = self._began_s
        self.tokens = 0

    def hear(self, read: Callable[[], str]) -> None:
        if self._heard_s is None:
            self._heard_s = self._clock()
            self.tokens = -count_tokens(read())

    def end(self, reply: ModelReply) -> None:
        self._ended_s = self._clock()
        if self._heard_s is not None:
            self.tokens += reply.tokens.reply or count_tokens(reply.text)

    @property
    def first_word_s(self) -> float:
        """Return when the first word came; a reply that is no stream comes all at once."""
        return (self._heard_s or self._ended_s) - self._began_s

    @property
    def writing_s(self) -> float:
        return 0.0 if self._heard_s is None else self._ended_s - self._heard_s
