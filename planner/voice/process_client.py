"""Run the recogniser in another process and keep one at hand. Knows pipes; not words.

Started where somebody may speak soon, and again after a death, by whoever asks next; ended where
nobody speaks for long. Whatever becomes of it, a caller gets an answer or a typed failure in
bounded time.
"""

from __future__ import annotations

import asyncio
import itertools
import logging
from asyncio.subprocess import Process
from collections.abc import Mapping, Sequence
from math import inf
from typing import Any

from planner.language.stop import calls_stop, is_stop
from planner.plan import Language
from planner.voice.recogniser import Recognition, StopListener, VoiceFailure
from planner.voice.wav import Sound
from processes.parent_death import worker_command
from processes.worker import STREAM_ERRORS, Rest, exchange, reap, spawn
from processes.worker_protocol import pack

log = logging.getLogger(__name__)

HEAR_S = 15.0
"""For 15 s of speech on a board ten times slower than a desktop."""
READY_S = 30.0
RESTS_AFTER_S = 600.0
"""Its 50 MB are a tenth of what all processes of a robot take. It is back within a second."""
MAX_WAITING = 3
"""Recordings at a time; what a fourth says is old when its turn comes."""


class VoiceWorker:
    """Hear recordings in another process: by the grammar in one site's names, or by a model."""

    def __init__(
        self,
        names: Sequence[str],
        command: Sequence[str] | None = None,
        model: Mapping[str, Any] | None = None,
        rests_after_s: float = RESTS_AFTER_S,
    ) -> None:
        """Take what the process is told first; nothing is started.

        Args:
            names: that the built-in grammar hears.
            command: another program than ours.
            model: ``sherpa``, a model's files, and ``threads``; None for the grammar.
            rests_after_s: of silence, until the process is ended. A model's stays: it takes long
                to load.
        """
        self._heard: dict[str, tuple[str, ...]] = {"names": tuple(names), "sentences": ()}
        self._model = dict(model or {})
        self._told: dict[str, tuple[str, ...]] = {}
        """What the process of now was started with."""
        self._command = command or worker_command("planner.voice.process_main")
        self._process: Process | None = None
        self._turn = asyncio.Lock()
        self._waiting = 0
        self._number = 0
        self._streams = itertools.count(1)
        self._warming: asyncio.Task[None] | None = None
        self._ending: asyncio.Task[None] | None = None
        self._reaping: asyncio.Task[None] | None = None
        self._rest = Rest(inf if self._model else rests_after_s, self._end_unused)
        self._at_work: set[asyncio.Task[Recognition]] = set()
        self.left_out: tuple[str, ...] = ()
        self.failure: VoiceFailure | None = None
        """Why the newest start came to nothing; None once one has."""

    @property
    def pid(self) -> int | None:
        """Return the process's id while one runs."""
        return None if self._process is None else self._process.pid

    def warm(self) -> None:
        """Have the process started, where none runs: somebody may speak soon."""
        if self._warming is None or self._warming.done():
            self._warming = asyncio.create_task(self._warm(), name="voice worker")

    def _end_unused(self) -> None:
        self._ending = asyncio.create_task(self._bury_in_turn(), name="voice worker")

    async def _bury_in_turn(self) -> None:
        async with self._turn:
            await self._bury()

    def know(self, names: Sequence[str], sentences: Sequence[str] = ()) -> None:
        """Hear other names and orders from now on; a process that runs is followed by another.

        Args:
            names: of places.
            sentences: the owner's own orders, as ``grammar.language_of`` takes them.
        """
        heard = {"names": tuple(names), "sentences": tuple(sentences)}
        if heard == self._heard:
            return
        self._heard = heard
        if self._process is not None:
            self.warm()

    async def hear(self, sound: Sound, *, awaits_answer: bool = False) -> Recognition:
        """Return the recognition; ``awaits_answer``: a question waits for a yes or no.

        Raises:
            VoiceFailure: ``recogniser_unavailable``, ``voice_busy`` or ``voice_timed_out``.
        """
        if self._waiting >= MAX_WAITING:
            text = f"{self._waiting} recordings are being heard; try again in a moment"
            raise VoiceFailure("voice_busy", text)
        self._waiting += 1
        work = self._begin(sound, {"awaits_answer": awaits_answer})
        work.add_done_callback(self._count_down)
        return await asyncio.shield(work)

    def listen(self) -> tuple[StopListener, ...]:
        """Return what hears one recording in the same process while it is spoken."""
        self.warm()
        return (WorkerListener(self, next(self._streams)),)

    async def hear_part(self, stream: int, sound: Sound) -> Recognition:
        """Return what the process has heard of a recording by now, since its last pause.

        Raises:
            VoiceFailure: ``recogniser_unavailable`` or ``voice_timed_out``.
        """
        return await asyncio.shield(self._begin(sound, {"stream": stream}))

    def _begin(self, sound: Sound, more: Mapping[str, Any]) -> asyncio.Task[Recognition]:
        """Hear in turn. Who goes away leaves it at work: to end it would cost the next order a
        model's loading.
        """
        work = asyncio.create_task(self._hear_in_turn(sound, more))
        self._at_work.add(work)
        work.add_done_callback(self._at_work.discard)
        work.add_done_callback(_take_failure)
        return work

    def _count_down(self, _: asyncio.Task[Recognition]) -> None:
        self._waiting -= 1

    async def _hear_in_turn(self, sound: Sound, more: Mapping[str, Any]) -> Recognition:
        async with self._turn:
            return await self._hear(sound, more)

    async def close(self) -> None:
        """End the process and wait until it is gone. Safe to call twice."""
        self._rest.cancel()
        works = [*self._at_work, *(each for each in (self._warming, self._ending) if each)]
        for work in works:
            work.cancel()
        await asyncio.gather(*works, return_exceptions=True)
        await self._bury()

    async def _warm(self) -> None:
        try:
            async with self._turn:
                await self._ready()
                while self._told != self._heard:  # other names came while it started
                    await self._ready()
        except VoiceFailure as failure:
            heard_by = "the model that is set" if self._model else "the built-in recogniser"
            log.warning("%s hears nothing: %s", heard_by, failure)

    async def _hear(self, sound: Sound, more: Mapping[str, Any]) -> Recognition:
        process = await self._ready()
        self._number += 1
        head = {
            "number": self._number,
            "rate_hz": sound.rate_hz,
            "channels": sound.channels,
            **more,
        }
        try:
            async with asyncio.timeout(HEAR_S):
                answer, _ = await exchange(process, pack(head, sound.pcm))
            if answer.get("number") != self._number or "failed" in answer:
                raise ValueError(str(answer.get("failed", "an answer out of turn")))
            return _read_answer(answer)
        except TimeoutError:
            await self._bury()
            raise VoiceFailure("voice_timed_out", f"after {HEAR_S:g} s") from None
        except STREAM_ERRORS as error:
            await self._bury()
            raise VoiceFailure("recogniser_unavailable", f"it failed: {error}") from None
        except BaseException:  # cancelled half-way: the next answer would be this one's
            await self._bury()
            raise

    async def _ready(self) -> Process:
        """Return a process that has said ready.

        Raises:
            VoiceFailure: there is none, and it says why.
        """
        try:
            process = await self._start()
        except VoiceFailure as failure:
            self.failure = failure
            raise
        self.failure = None
        return process

    async def _start(self) -> Process:
        self._rest.put_off()
        alive = self._process is not None and self._process.returncode is None
        if self._process is not None and alive and self._told == self._heard:
            return self._process
        await self._bury()
        try:
            self._process = process = await spawn(self._command)
            self._told = self._heard
            async with asyncio.timeout(READY_S):
                greeting, _ = await exchange(process, pack({**self._told, **self._model}))
        except STREAM_ERRORS as error:
            await self._bury()
            text = f"it did not start: {str(error) or type(error).__name__}"
            raise VoiceFailure("recogniser_unavailable", text) from None
        except BaseException:
            await self._bury()
            raise
        if "ready" not in greeting:
            await self._bury()
            raise VoiceFailure("recogniser_unavailable", str(greeting.get("detail")))
        self.left_out = tuple(str(name) for name in greeting["ready"])
        return process

    async def _bury(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            self._reaping = asyncio.create_task(reap(process))
        if self._reaping is not None:  # or of one that was cancelled as it buried
            await asyncio.shield(self._reaping)


class WorkerListener:
    """Have a voice process hear one recording while it is spoken."""

    def __init__(self, worker: VoiceWorker, stream: int) -> None:
        self._worker, self._stream = worker, stream

    async def take(self, sound: Sound) -> Recognition | None:
        """Hear the next samples; return a stop as soon as one is heard.

        Raises:
            VoiceFailure: ``recogniser_unavailable`` or ``voice_timed_out``.
        """
        heard = await self._worker.hear_part(self._stream, sound)
        stops = is_stop(heard.transcript) or calls_stop(heard.transcript)
        return heard if heard.understood and stops else None


def _take_failure(work: asyncio.Task[Recognition]) -> None:
    """Look at a failure that nobody waits for any more, or it would be logged as forgotten."""
    if not work.cancelled():
        work.exception()


def _read_answer(answer: dict[str, Any]) -> Recognition:
    return Recognition(
        str(answer["transcript"]),
        float(answer["confidence"]),
        answer["understood"] is True,
        Language(answer.get("language", "en")),
        str(answer.get("by", "grammar")),
    )
