"""Saying sentences aloud: in order, not too late, silent at once, and never in the way."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field

import pytest

from planner.plan import Language
from planner.plan.quiet_hours import QuietHours
from planner.voice import SpeechFailure, SpeechOutput
from planner.voice.speech_output import MAX_AGE_S, MAX_WAITING

EN, ZH = Language.EN, Language.ZH


@dataclass
class Voice:
    """Make words their own sound, and fail where a test says so."""

    fails: bool = False
    made: list[tuple[str, Language]] = field(default_factory=list)

    async def make(self, text: str, language: Language) -> bytes:
        self.made.append((text, language))
        if self.fails:
            raise SpeechFailure("speech_engine", "no voice")
        return text.encode()

    async def close(self) -> None:
        pass


@dataclass
class Loudspeaker:
    """Sound until a test lets a sentence end."""

    ends: bool = True
    heard: list[str] = field(default_factory=list)
    broken_off: list[str] = field(default_factory=list)
    let_end: asyncio.Event = field(default_factory=asyncio.Event)

    async def play(self, sound: bytes) -> None:
        self.heard.append(sound.decode())
        try:
            if not self.ends:
                await self.let_end.wait()
        except asyncio.CancelledError:
            self.broken_off.append(sound.decode())
            raise


@dataclass
class Room:
    """Hold a speaker with everything around it."""

    voice: Voice = field(default_factory=Voice)
    box: Loudspeaker = field(default_factory=Loudspeaker)
    now_s: float = 0.0
    minute: int = 12 * 60
    quiet: QuietHours | None = None

    @asynccontextmanager
    async def speaker(self) -> AsyncIterator[SpeechOutput]:
        made = SpeechOutput(
            self.voice, self.box, self.quiet,
            clock=lambda: self.now_s, minute=lambda: self.minute,
        )  # fmt: skip
        made.start()
        try:
            yield made
        finally:
            await made.close()


async def settle() -> None:
    for _ in range(20):
        await asyncio.sleep(0)


async def test_sentences_are_said_in_their_order_and_language() -> None:
    room = Room()
    async with room.speaker() as speaker:
        speaker.say("Dinner is\n ready.", EN)
        speaker.say("饭好了。", ZH)
        await settle()
    assert room.voice.made == [("Dinner is ready.", EN), ("饭好了。", ZH)]
    assert room.box.heard == ["Dinner is ready.", "饭好了。"]


async def test_hush_breaks_off_what_sounds_and_forgets_what_waits() -> None:
    room = Room(box=Loudspeaker(ends=False))
    async with room.speaker() as speaker:
        for text in ("one", "two", "three"):
            speaker.say(text, EN)
        await settle()
        speaker.hush()
        await settle()
        assert (room.box.heard, room.box.broken_off) == (["one"], ["one"])
        room.box.ends = True
        speaker.say("four", EN)
        await settle()
        assert room.box.heard == ["one", "four"]
        assert speaker.trouble is None  # to be silenced is no failure


async def test_what_waited_too_long_or_is_too_much_is_left_out() -> None:
    room = Room(box=Loudspeaker(ends=False))
    async with room.speaker() as speaker:
        speaker.say("first", EN)
        await settle()
        for number in range(MAX_WAITING + 2):
            speaker.say(f"late {number}", EN)
        assert speaker.left_out == 2
        room.now_s = MAX_AGE_S + 0.1
        room.box.let_end.set()
        await settle()
        assert room.box.heard == ["first"]
        assert speaker.left_out == MAX_WAITING + 2


async def test_nothing_is_said_in_quiet_hours_or_after_they_began() -> None:
    room = Room(quiet=QuietHours.read("22:00-07:00"))
    async with room.speaker() as speaker:
        speaker.say("good night", EN)
        await settle()
        room.minute = 23 * 60
        speaker.say("now", EN)
        await settle()
        assert (room.box.heard, speaker.left_out) == (["good night"], 1)
        assert speaker.is_quiet


async def test_a_voice_that_fails_is_told_once_and_the_next_sentence_has_its_turn(
    caplog: pytest.LogCaptureFixture,
) -> None:
    room = Room(voice=Voice(fails=True))
    async with room.speaker() as speaker:
        for text in ("one", "two"):
            speaker.say(text, EN)
        await settle()
        assert speaker.trouble is not None
        assert speaker.trouble.code == "speech_engine"
        room.voice.fails = False
        speaker.say("three", EN)
        await settle()
        assert speaker.trouble is None
        assert room.box.heard == ["three"]
    assert len([each for each in caplog.records if "speech_engine" in each.message]) == 1


async def test_a_mute_speaker_takes_everything_and_says_nothing() -> None:
    speaker = SpeechOutput(None, None)
    speaker.start()
    speaker.say("hello", EN)
    speaker.hush()
    await speaker.close()
    assert speaker.left_out == 0
