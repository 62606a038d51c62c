"""Play a server that hears and speaks: transcriptions as the switches say, speech as a tone."""

from __future__ import annotations

import asyncio
import io
import math
import struct
import wave
from typing import Any

from fastapi import FastAPI, Request
from starlette.responses import JSONResponse, Response

from pons.mock_llm.app import object_of, raw_of
from pons.mock_llm.replies import GARBAGE
from pons.mock_llm.server import MockServer, error
from tests.pons.mock_llm.faults import BadSwitches

RATE_HZ = 16_000
SECONDS_A_CHARACTER = 0.06
MAX_SECONDS = 30.0


def transcription(switches: BadSwitches, body: bytes) -> dict[str, Any] | None:
    """Return what a request's sound is said to be, or None where no WAV came with it."""
    if b"RIFF" not in body or b"WAVEfmt " not in body:
        return None
    told: dict[str, Any] = {"text": switches.transcript}
    if b"verbose_json" in body and switches.probability is not None:
        silent = 0.95 if not switches.transcript else 0.01
        log = math.log(max(switches.probability, 1e-9))
        told["segments"] = [{"avg_logprob": log, "no_speech_prob": silent}]
    return told


def tone(text: str) -> bytes:
    """Return a WAV that lasts about as long as a text does when it is spoken."""
    count = int(RATE_HZ * min(MAX_SECONDS, SECONDS_A_CHARACTER * max(1, len(text))))
    samples = (int(3000 * math.sin(2 * math.pi * 220 * k / RATE_HZ)) for k in range(count))
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE_HZ)
        file.writeframes(b"".join(struct.pack("<h", each) for each in samples))
    return out.getvalue()


def add_voices(app: FastAPI, mock: MockServer) -> None:
    """Add the routes of a server that hears and speaks."""

    @app.post("/v1/audio/transcriptions")
    async def transcribe(request: Request) -> Response:
        fault, raw = mock.next_fault(), await raw_of(request)
        await asyncio.sleep(mock.switches.delay_s)
        early = await mock.instead(fault, {}, request)
        if early is not None:
            return early
        told = None if raw is None else transcription(_switches(mock), raw)
        if told is None:
            return error(400, "no WAV came with the request")
        if fault == "garbage":
            return Response(GARBAGE[mock.calls % len(GARBAGE)], media_type="application/json")
        return JSONResponse(told)

    @app.post("/v1/audio/speech")
    async def speak(request: Request) -> Response:
        fault, body = mock.next_fault(), object_of(await raw_of(request))
        await asyncio.sleep(mock.switches.delay_s)
        early = await mock.instead(fault, {}, request)
        if early is not None:
            return early
        if body is None or not isinstance(body.get("input"), str):
            return error(400, "the body is no JSON object with a text input")
        sound = b"no sound" if fault == "garbage" else tone(body["input"])
        return Response(sound, media_type="audio/wav")


def _switches(mock: MockServer) -> BadSwitches:
    assert isinstance(mock.switches, BadSwitches)
    return mock.switches
