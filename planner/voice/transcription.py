"""Have a server that the owner named hear a recording: OpenAI's ``/audio/transcriptions``.

What comes back is text and, from servers that tell it, how sure they are; nothing else of an answer
is believed. A server that tells no probabilities is never sure: its orders wait for a yes.
"""

from __future__ import annotations

import array
import io
import json
import math
import sys
import unicodedata
import wave
from typing import TYPE_CHECKING, Any

from planner.language.folding import has_chinese
from planner.outbound import Address, CallFailure
from planner.plan import Language
from planner.voice.recogniser import Recognition, VoiceFailure
from wire import ConfigError

if TYPE_CHECKING:
    from planner.outbound.caller import Transport
    from planner.settings import VoiceSettings
    from planner.voice.recogniser import StopListener
    from planner.voice.wav import Sound

ROUTE = "/audio/transcriptions"
MAX_ANSWER_BYTES = 200_000
MAX_TEXT = 500
"""Characters; as many as a typed order may have."""
UNTOLD = 0.5
"""The confidence of a server that tells none: understood, and never sure."""
UNDERSTOOD = 0.3
"""Recognisers of this kind write words into silence and noise, and then give themselves less."""
SILENT_PEAK = 200
"""Of 32767, as in the built-in recogniser: what is quieter is not sent."""


def open_caller(
    settings: VoiceSettings, transport: Transport | None = None
) -> TranscriptionServer | None:
    """Return the client of the server that is set, or None where none is.

    Raises:
        ConfigError: ``voice_url``, or ``voice_offhost`` where the yes is missing.
    """
    if settings.url is None:
        return None
    address = Address.parse(settings.url, ROUTE, "voice")
    if not address.local and not settings.allow_offhost:
        raise ConfigError(
            "voice_offhost",
            f"people's voices would be sent to {address.host}; if that is meant, set "
            "allow_offhost = true under [voice]",
        )
    return TranscriptionServer(address, settings, transport)


class TranscriptionServer:
    """Send recordings to one server and judge its answers."""

    def __init__(
        self,
        address: Address,
        settings: VoiceSettings,
        transport: Transport | None = None,
    ) -> None:
        from planner.outbound.caller import Caller  # httpx costs 0.1 s: not for nothing

        self._settings = settings
        self._verbose = True
        """Ask for probabilities, until the server once refused to tell them."""
        key = settings.key.get_secret_value() if settings.key is not None else ""
        self._caller = Caller(address, key, timeout_s=settings.timeout_s, transport=transport)

    @property
    def host(self) -> str:
        """Return the server's name."""
        return self._caller.address.host

    async def close(self) -> None:
        """Give the connections back."""
        await self._caller.close()

    async def hear(self, sound: Sound, *, awaits_answer: bool = False) -> Recognition:
        """Return what the server heard. The caller holds the deadline.

        Raises:
            VoiceFailure: ``transcription_`` and the reason of ``planner.outbound``.
        """
        del awaits_answer  # a free recogniser hears a yes as any other word
        if is_silent(sound):
            return Recognition("", 0.0, understood=False, by="server")
        try:
            return read_transcription(await self._ask(sound))
        except CallFailure as failure:
            raise VoiceFailure(f"transcription_{failure.why}", str(failure)) from None

    def warm(self) -> None:
        """Do nothing: a server is there or not."""

    def listen(self) -> tuple[StopListener, ...]:
        """Return nothing: such a server takes whole recordings."""
        return ()

    async def _ask(self, sound: Sound) -> bytes:
        file = ("order.wav", as_wav(sound), "audio/wav")
        for verbose in (True, False) if self._verbose else (False,):
            form = {
                "model": self._settings.model,
                "temperature": "0",
                "response_format": "verbose_json" if verbose else "json",
            }
            if not verbose:
                form["include[]"] = "logprobs"
            try:
                answer = await self._caller.post(
                    most_bytes=MAX_ANSWER_BYTES, form=form, files={"file": file}
                )
            except CallFailure as failure:
                if verbose and failure.why == "bad_request":
                    continue
                raise
            self._verbose = verbose
            return answer.body
        raise CallFailure("the server takes neither form of question", why="bad_request")


def read_transcription(body: bytes) -> Recognition:
    """Return the recognition that an answer's JSON is.

    Raises:
        CallFailure: ``bad_reply``: it is none.
    """
    try:
        told = json.loads(body)
    except (ValueError, RecursionError):
        raise CallFailure(f"{len(body)} bytes that are no JSON", why="bad_reply") from None
    if not isinstance(told, dict) or not isinstance(told.get("text"), str):
        raise CallFailure("JSON without a field text", why="bad_reply")
    text = clean(told["text"])
    confidence = confidence_of(told) if text else 0.0
    return Recognition(
        text,
        confidence,
        understood=bool(text) and confidence >= UNDERSTOOD,
        language=Language.ZH if has_chinese(text) else Language.EN,
        by="server",
    )


def clean(text: str) -> str:
    """Return one line of what can be seen, at most 500 characters."""
    seen = "".join(" " if unicodedata.category(each)[0] in "CZ" else each for each in text[:4000])
    return " ".join(seen.split())[:MAX_TEXT]


def confidence_of(told: dict[str, Any]) -> float:
    """Return 0 to 1: the mean probability of a token, less what may be no speech at all.

    Whisper's servers tell it for each segment, OpenAI's newer models for each token; nonsense
    among the figures counts as no probability at all.
    """
    segments, tokens = told.get("segments"), told.get("logprobs")
    if isinstance(segments, list) and segments:
        logs = [_number(each, "avg_logprob") for each in segments]
        silent = [_number(each, "no_speech_prob") for each in segments]
        likely = _likelihood(logs)
        speech = 1.0 - max((each for each in silent if each is not None), default=0.0)
        return UNTOLD if likely is None else min(1.0, max(0.0, likely * speech))
    if isinstance(tokens, list) and tokens:
        likely = _likelihood([_number(each, "logprob") for each in tokens])
        return UNTOLD if likely is None else likely
    return UNTOLD


def _likelihood(logs: list[float | None]) -> float | None:
    """Return the geometric mean of probabilities; None where none is told, 0 among nonsense."""
    told = [each for each in logs if each is not None]
    if not told:
        return None
    mean = sum(told) / len(told)
    return math.exp(mean) if len(told) == len(logs) and mean <= 0.0 else 0.0


def _number(entry: object, name: str) -> float | None:
    value = entry.get(name) if isinstance(entry, dict) else None
    right = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if right and isinstance(value, int | float) else None


def is_silent(sound: Sound) -> bool:
    """Return whether nothing in a recording is loud enough to be heard."""
    samples = array.array("h")
    samples.frombytes(sound.pcm)
    if sys.byteorder == "big":
        samples.byteswap()
    if not samples:
        return True
    middle = sum(samples) / len(samples)  # a sound card's offset is no sound
    return not max(max(samples) - middle, middle - min(samples)) >= SILENT_PEAK


def as_wav(sound: Sound) -> bytes:
    """Return the samples as a WAV file of our own: no byte of the one that came is sent on."""
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(sound.channels)
        file.setsampwidth(2)
        file.setframerate(sound.rate_hz)
        file.writeframes(sound.pcm)
    return out.getvalue()
