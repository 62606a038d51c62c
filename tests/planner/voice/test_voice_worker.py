"""The voice process and its keeper: answers, deaths, delays, crowds, and nothing left behind."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import pytest

from planner.voice import Recognition, Sound, VoiceFailure, VoiceWorker, process_client
from processes import worker_protocol
from tests.processes.small_worker import until

pytestmark = pytest.mark.nightly(keep=7)


SECOND = Sound(16_000, 1, bytes(32_000))
ECHO = """
import sys
exec(compile(open({frames!r}, "rb").read(), {frames!r}, "exec"))  # alone: our packages take 0.1 s
def read():
    header = sys.stdin.buffer.read(HEADER.size)
    if not header: sys.exit(0)
    head, body = read_lengths(header)
    return unpack(sys.stdin.buffer.read(head)), sys.stdin.buffer.read(body)
def write(**head):
    sys.stdout.buffer.write(pack(head)); sys.stdout.buffer.flush()
names, _ = read()
write(ready=names["names"][1:])
while True:
    head, pcm = read()
    {act}
"""
TELL = 'write(number=head["number"], transcript=str(len(pcm)), confidence=0.75, understood=True)'


def stub(act: str) -> tuple[str, ...]:
    text = ECHO.replace("{act}", act).replace("{frames!r}", repr(worker_protocol.__file__))
    return (sys.executable, "-S", "-c", text)


@asynccontextmanager
async def running(
    *command: str, rests_after_s: float = process_client.RESTS_AFTER_S
) -> AsyncIterator[VoiceWorker]:
    ears = VoiceWorker(("kitchen", "xyzzy"), command or None, rests_after_s=rests_after_s)
    try:
        yield ears
    finally:
        await ears.close()
        assert ears.pid is None


async def code_of(ears: VoiceWorker) -> str:
    with pytest.raises(VoiceFailure) as failure:
        await ears.hear(SECOND)
    return failure.value.code


async def test_the_real_process_hears_silence_and_ends() -> None:
    pytest.importorskip("pocketsphinx")
    async with running() as ears:
        ears.warm()
        assert await ears.hear(SECOND) == Recognition("", 0.0, understood=False)
        assert ears.left_out == ("xyzzy",)
        pid = ears.pid
        assert await ears.hear(SECOND) == Recognition("", 0.0, understood=False)
        assert ears.pid == pid
    with pytest.raises(ProcessLookupError):
        os.kill(pid or 0, 0)


async def test_new_names_are_known_without_a_restart_of_the_planner() -> None:
    async with running(*stub(TELL)) as ears:
        ears.warm()
        ears.know(("kitchen", "xyzzy"))  # the same as before: the process stays
        assert (await ears.hear(SECOND)).understood
        pid, left_out = ears.pid, ears.left_out
        ears.know(("kitchen", "corner", "nook"))
        ears.know(("kitchen", "corner"))
        assert (await ears.hear(SECOND)).understood
        assert (left_out, ears.left_out) == (("xyzzy",), ("corner",))
        assert ears.pid != pid


async def test_where_nobody_speaks_no_process_runs_and_it_is_back_before_the_first_word() -> None:
    async with running(*stub(TELL), rests_after_s=0.05) as ears:
        ears.know(("kitchen", "nook"))
        await asyncio.sleep(0.1)
        assert ears.pid is None, "new names alone start none"
        for begin in (ears.warm, ears.listen):
            begin()
            await until(lambda: ears.pid is not None)
            await until(lambda: ears.pid is None)
            assert ears.left_out == ("nook",)
        assert (await ears.hear(SECOND)).understood


async def test_closed_as_it_ends_unused_it_leaves_no_process() -> None:
    async with running(*stub(TELL), rests_after_s=0.0) as ears:
        ears.warm()
        await until(lambda: ears.pid is not None)
        pid = ears.pid
        while ears.pid is not None:  # noqa: ASYNC110  # and not a moment later: it is being ended
            await asyncio.sleep(0)
    assert pid is not None
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


async def test_recordings_come_whole_and_one_after_the_other() -> None:
    async with running(*stub(TELL)) as ears:
        sounds = [Sound(16_000, 1, bytes(2 * n)) for n in (1_600, 240_000, 3)]
        heard = await asyncio.gather(*map(ears.hear, sounds))
        assert [one.transcript for one in heard] == ["3200", "480000", "6"]


async def test_a_fourth_at_once_is_told_to_come_again() -> None:
    async with running(*stub(TELL)) as ears:
        asked = [asyncio.create_task(ears.hear(SECOND)) for _ in range(process_client.MAX_WAITING)]
        await asyncio.sleep(0)
        assert await code_of(ears) == "voice_busy"
        assert all(heard.understood for heard in await asyncio.gather(*asked))


@pytest.mark.parametrize(
    "act",
    [
        "sys.exit(3)",
        'sys.stdout.buffer.write(b"x" * 64); sys.stdout.buffer.flush()',
        "write(number=0, transcript='', confidence=0.0, understood=True)",
        "write(number=head['number'])",
        "write(number=head['number'], failed='RuntimeError: broken')",
    ],
)
async def test_a_failure_is_typed_and_the_next_order_gets_a_new_process(act: str) -> None:
    async with running(*stub(act)) as ears:
        assert await code_of(ears) == "recogniser_unavailable"
        assert await code_of(ears) == "recogniser_unavailable"


async def test_what_takes_too_long_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process_client, "HEAR_S", 0.05)
    async with running(*stub("import time; time.sleep(60)")) as ears:
        assert await code_of(ears) == "voice_timed_out"
        assert ears.pid is None


async def test_who_goes_away_leaves_no_answer_for_the_next() -> None:
    async with running(*stub("import time; time.sleep(0.2); " + TELL)) as ears:
        task = asyncio.create_task(ears.hear(SECOND))
        while ears.pid is None:  # noqa: ASYNC110
            await asyncio.sleep(0.001)
        await asyncio.sleep(0.05)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert (await ears.hear(Sound(16_000, 1, bytes(4)))).transcript == "4"


@pytest.mark.parametrize("command", [("/no/such/program",), (sys.executable, "-S", "-c", "")])
async def test_where_there_is_no_recogniser_it_says_so(command: tuple[str, ...]) -> None:
    async with running(*command) as ears:
        ears.warm()
        await asyncio.sleep(0)
        assert await code_of(ears) == "recogniser_unavailable"
