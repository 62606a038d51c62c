"""Ask a model for a plan: prompt, call, judge, one repair turn, all inside one deadline.

Never returns what is no plan of the closed vocabulary, and never asks a third time.
"""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING

from planner.brain.endpoint.completion import ModelReply, Tokens
from planner.brain.endpoint.image_client import EndpointLooker, LayOut, Shrink
from planner.brain.endpoint.line import Line
from planner.brain.endpoint.plan_draft import Drafting
from planner.brain.endpoint.plan_reply import Planned, Unusable, clean, judge
from planner.brain.endpoint.reply_truth import find_untruth, only_talks
from planner.brain.errors import BadPlan
from planner.brain.interface import ThinkRequest, ThinkResult
from planner.brain.model_replies import ReplyCollector, ReplyTurn
from planner.brain.offline_brain import read_untouched
from planner.brain.prompt import Prompt
from planner.brain.schema import Message, schema_of
from planner.brain.streamed_draft import Draft, Hear
from planner.brain.usage_meter import Meter
from planner.language.catalogue import message, say
from planner.plan import (
    PLAN,
    TOOL_CALLS,
    BrainTag,
    Clarify,
    Code,
    Language,
    Refuse,
    Vocabulary,
    say_same,
)
from planner.settings import ModelSettings

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx

    from planner.plan import Tool

log = logging.getLogger(__name__)


class EndpointBrain:
    """Plan by a model behind an OpenAI-compatible endpoint."""

    def __init__(
        self,
        settings: ModelSettings,
        home: Path,
        *,
        prompt: Prompt | None = None,
        transport: httpx.AsyncBaseTransport | None = None,
        meter: Meter | None = None,
        replies: ReplyCollector | None = None,
        tools: Callable[[], tuple[Tool, ...]] = tuple,
    ) -> None:
        """Judge the address and read the prompt; nothing is asked yet.

        Args:
            settings: where and how.
            home: where the dialect is remembered.
            prompt: another than prompts/plan.md.
            transport: another than the network, for tests.
            meter: counts every call and may refuse it; None: nobody keeps a budget.
            replies: keeps what the model wrote; None: nothing is kept.
            tools: lists what servers of the owner's can be asked now.

        Raises:
            ConfigError: ``model_url``, ``model_offhost``, ``prompt_missing``,
                ``prompt_malformed``.
        """
        self._line = Line(settings, home, transport, meter)
        self._replies, self._tools = replies or ReplyCollector(0), tools
        self.address = self._line.address
        self._prompt = prompt or Prompt.load()
        self._client, self._asker = self._line.client, self._line.asker
        self._tag = BrainTag(
            name=clean(settings.name),
            version=str(self._prompt.version),
            prompt=self._prompt.tag,
        )

    @property
    def tag(self) -> BrainTag:
        """Return the model's name, and the prompt it is asked with."""
        return self._tag

    def warm(self, vocabulary: Vocabulary) -> None:
        """Render the prompt of this closed world, so that the first goal need not wait for it."""
        self._prompt.messages(ThinkRequest(text="", vocabulary=vocabulary))

    async def warm_up(self, request: ThinkRequest) -> None:
        """Have a model on this machine loaded before anybody asks, where the owner wants that."""
        if self._line.warms_up:
            schema = schema_of(request.vocabulary, request.runnable)
            await self._line.warm_up(self._prompt.messages(request), schema)

    def looker(self, shrink: Shrink | None = None, lay_out: LayOut | None = None) -> EndpointLooker:
        """Return the asker of the same model about pictures, over the same line.

        Raises:
            ConfigError: ``prompt_missing``, ``prompt_malformed``.
        """
        return EndpointLooker(self._line, shrink, lay_out, self._replies)

    async def close(self) -> None:
        """Give the connections back."""
        await self._line.close()

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the model's plan of a sentence; a listener hears it as it is written.

        Raises:
            BadPlan: neither reply is a plan.
            BrainDown: the model does not answer, or not within the deadline.
            OutOfBudget: a call was refused by the meter.
        """
        request = self._with_tools(request)

        async def talk(end_s: float) -> ThinkResult:
            return await self._talk(request, end_s, hear)

        def tell_slow() -> None:
            if hear is not None:
                language = request.language or Language.EN
                hear(Draft(text=say("model_error.slow").of(language), loads=True))

        return await self._line.turn(request.goal, talk, "plan", tell_slow)

    def _with_tools(self, request: ThinkRequest) -> ThinkRequest:
        """Return the request with the tools of now: a model alone is offered any."""
        tools = self._tools()
        if not tools:
            return request
        names = request.vocabulary.model_copy(update={"tools": tools})
        runnable = request.runnable | TOOL_CALLS
        return request.model_copy(update={"vocabulary": names, "runnable": runnable})

    async def _talk(self, request: ThinkRequest, end_s: float, hear: Hear | None) -> ThinkResult:
        messages = self._prompt.messages(request)
        schema = schema_of(request.vocabulary, request.runnable)
        told = None if hear is None else Drafting(request.vocabulary, request.runnable, hear)
        first = await self._asker.ask(messages, schema, end_s, told)
        plan = _without_vain_offers(self._plan_of(first, request), request)
        plan = await self._held_to_truth(plan, request, messages)
        self._keep(request, _turn_of(request), first, plan)
        if not isinstance(plan, Unusable):
            return self._make_result(plan, 1, first.tokens)
        log.info("%s wrote no plan, asked again: %s", self._tag.name, plan)
        again = [*messages, *self._prompt.repair(first.text, plan.reasons)]
        second = await self._asker.ask(again, schema, end_s, told, again=True)
        mended = await self._held_to_truth(
            self._plan_of(second, request), request, messages, mended=True
        )
        self._keep(request, ReplyTurn.REPAIR, second, mended)
        if isinstance(mended, Unusable):
            cost = (first.tokens + second.tokens).total
            raise BadPlan(f"asked twice: {mended}"[:400], calls=2, tokens=cost, code=mended.code)
        return self._make_result(mended, 2, first.tokens + second.tokens)

    async def _held_to_truth(
        self,
        plan: Planned | Unusable,
        request: ThinkRequest,
        messages: list[Message],
        *,
        mended: bool = False,
    ) -> Planned | Unusable:
        """Return why a plan is not to be told or done, where it is one and there is a reason."""
        if isinstance(plan, Unusable):
            return plan
        reading = await read_untouched(request) if only_talks(plan) else None
        instructions = messages[0]["content"]
        return find_untruth(plan, reading, request, instructions, mended=mended) or plan

    def _keep(
        self, request: ThinkRequest, turn: ReplyTurn, reply: ModelReply, plan: Planned | Unusable
    ) -> None:
        self._replies.keep(
            request.goal,
            reply.refusal or reply.text,
            model=self._tag.name,
            turn=turn,
            used=not isinstance(plan, Unusable)
            and (request.accepts is None or request.accepts(plan)),
        )

    def _make_result(self, plan: Planned, calls: int, spent: Tokens) -> ThinkResult:
        return ThinkResult(
            plan=plan,
            brain=self._tag,
            calls=calls,
            tokens=spent.total,
            prompt_tokens=spent.prompt,
            reply_tokens=spent.reply,
        )

    def _plan_of(self, reply: ModelReply, request: ThinkRequest) -> Planned | Unusable:
        """Judge a reply. The key, which a server may spell as it likes, is struck out last."""
        struck = self._client.secret.redact
        if reply.refusal is not None:
            return _make_refusal(struck(reply.refusal), request)
        judged = judge(reply.text, request.vocabulary, request.runnable)
        if not isinstance(judged, Unusable):
            written = judged.model_dump_json()
            safe = struck(written)
            return judged if safe == written else PLAN.validate_json(safe)
        reasons = judged.reasons if reply.trouble is None else (reply.trouble, *judged.reasons)
        return Unusable(tuple(map(struck, reasons)))


def _turn_of(request: ThinkRequest) -> ReplyTurn:
    """Return what the first reply to a request is asked for."""
    if not request.observed:
        return ReplyTurn.PLAN
    failed = request.observed[-1].result == "failed"
    return ReplyTurn.REPLAN if failed else ReplyTurn.DECIDE


def _without_vain_offers(plan: Planned | Unusable, request: ThinkRequest) -> Planned | Unusable:
    """Return why a question is none where a yes to what it offers could not be kept.

    Asked of a first reply alone: what the mended one offers in vain is taken back behind the brain.
    """
    refuses = request.refuse_offer
    if refuses is None or not isinstance(plan, Clarify):
        return plan
    told = [(each.text, refuses(each.text)) for each in plan.options]
    reasons = tuple(f"option “{clean(text)[:80]}”: {why.en}" for text, why in told if why)
    return Unusable(reasons) if reasons else plan


def _make_refusal(words: str, request: ThinkRequest) -> Refuse:
    """Take a model's own refusal as one: the offline brain must not do what a model would not."""
    told = clean(words)[:200]
    rule = say("model.declined", told=told)
    said = message(Code.UNSAFE, part=say_same(clean(request.text)[:60]), rule=rule)
    return Refuse(code=Code.UNSAFE, reason=said)
