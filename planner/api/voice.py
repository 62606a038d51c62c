"""Serve spoken goals: check the recording, hear it, and hand the text on as typed text is."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query, Request, Response
from pydantic import BaseModel, ConfigDict

from planner.api.goals import IdempotencyKey
from planner.api.interfaces import Services
from planner.api.operator import act_behind
from planner.api.problems import HttpProblem
from planner.language.catalogue import say
from planner.language.sentence import parse
from planner.language.stop import StopReading
from planner.people import name_asker
from planner.plan import Bilingual, Goal, Language
from planner.voice import (
    STOP_DOUBT,
    BadSound,
    Recognition,
    VoiceAbilities,
    VoiceFailure,
    read_wav,
)

STATUS = {
    "not_wav": 415,
    "wav_unsupported": 415,
    "audio_too_long": 413,
    "body_too_large": 413,
}
_BODY: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "content": {"audio/wav": {"schema": {"type": "string", "format": "binary"}}},
    }
}

Confirm = Annotated[bool, Query(description="Show the plan and wait for a yes")]
Replace = Annotated[bool, Query(description="Forget the running goal and the queue")]


class SpokenOutcome(BaseModel):
    """Say whether the recording became a goal, and if not, why."""

    model_config = ConfigDict(frozen=True)

    code: Literal["heard", "not_heard"]
    message: Bilingual | None = None


class VoiceResult(BaseModel):
    """Report the transcript of a recording and the goal that it became."""

    model_config = ConfigDict(frozen=True)

    transcript: str
    confidence: float
    language: Language
    recogniser: str
    """What heard it: ``grammar``, ``server`` or ``sherpa``."""
    instead_of: str | None = None
    """The recogniser that should have heard it and did not."""
    trouble: str | None = None
    """Stable code of why it did not."""
    understood: str | None = None
    """The text that became the goal; none where nothing was heard surely enough."""
    goal: Goal | None = None
    outcome: SpokenOutcome


def routes(services: Services) -> APIRouter:
    """Return the voice route."""
    router = APIRouter(prefix="/v1", tags=["goals"])

    @router.post("/voice", status_code=202, operation_id="give_spoken_goal", openapi_extra=_BODY)
    async def speak(
        request: Request,
        response: Response,
        confirm: Confirm = False,
        replace: Replace = False,
        idempotency_key: IdempotencyKey = None,
    ) -> VoiceResult:
        """Give a goal by a recording (WAV, 16-bit PCM, at most 15 s), in a language that is heard.

        202 with the goal, which waits for a yes where the order was heard but not quite surely; 200
        without one where none was heard: nothing new begins.
        """
        services.speaker.hush()  # who speaks to it is not spoken over
        heard = await _recognise(services, await request.body())
        if not (heard.understood or _may_be_stop(services, heard)):
            response.status_code = 200
            code = "no_answer_heard" if services.goals.awaits_answer() else "not_heard"
            both = len(services.voice.languages) > 1 and heard.instead_of is None
            told = say(f"voice.{code}_in_any" if both else f"voice.{code}")
            outcome = SpokenOutcome(code="not_heard", message=told)
            return VoiceResult(**_facts(heard), outcome=outcome)
        text = heard.transcript
        goal = await services.goals.submit(
            text,
            language=heard.language,
            confirm=confirm or not (heard.sure or parse(text).reading is StopReading.ORDER),
            replace=replace,
            idempotency_key=idempotency_key,
            act=act_behind(services.robot, parse(text), None),
            by=name_asker("voice"),
        )
        outcome = SpokenOutcome(code="heard")
        return VoiceResult(**_facts(heard), understood=text, goal=goal, outcome=outcome)

    @router.get("/voice", operation_id="get_voice")
    async def abilities() -> VoiceAbilities:
        """Show which languages are heard and by what, and whether the robot itself speaks."""
        services.ears.warm()  # who asks this has a microphone
        return services.voice

    @router.post("/voice/hush", operation_id="hush")
    async def hush() -> VoiceAbilities:
        """Break off what the robot is saying, as when somebody begins to speak to it."""
        services.speaker.hush()
        return services.voice

    return router


def _facts(heard: Recognition) -> dict[str, Any]:
    """Return what is told of every recording, whatever becomes of it."""
    return {
        "transcript": heard.transcript,
        "confidence": heard.confidence,
        "language": heard.language,
        "recogniser": heard.by,
        "instead_of": heard.instead_of,
        "trouble": heard.trouble,
    }


def _may_be_stop(services: Services, heard: Recognition) -> bool:
    """Return whether a badly heard recording is a stop that the robot should rather obey."""
    return heard.confidence >= STOP_DOUBT and services.goals.hears_stop(heard.transcript)


async def _recognise(services: Services, data: bytes) -> Recognition:
    try:
        sound = read_wav(data)
        return await services.ears.hear(sound, awaits_answer=services.goals.awaits_answer())
    except BadSound as bad:
        raise HttpProblem(STATUS.get(bad.code, 400), bad.code, bad.detail) from None
    except VoiceFailure as failure:
        raise HttpProblem(503, failure.code, failure.detail) from None
