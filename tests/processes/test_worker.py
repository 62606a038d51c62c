"""Kill, freeze and mislead a worker; who asks gets an answer or a typed failure."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import psutil
import pytest

from processes.parent_death import WORKER_NICE
from tests.processes.nice_values import leads_its_session, stand_of
from tests.processes.small_worker import LIMIT_S, Tiny, code_of, pid_of, running, story, until
from tests.processes.small_worker_main import SPOILS, Trouble


@story
async def test_many_at_once_are_each_answered_with_their_own() -> None:
    async with running() as kept:
        bodies = [bytes([n]) * n * 40_000 + b"!" for n in range(5)]  # more than a pipe holds
        answers = await asyncio.gather(*(kept.asked(body) for body in bodies))
        assert answers == [(pid_of(kept), body[::-1]) for body in bodies]
        child = psutil.Process(pid_of(kept))
        assert child.ppid() == os.getpid()
        at_nice = await kept.ask({}, (), LIMIT_S, lambda frame: frame[0]["imported_at_nice"])
        assert at_nice == child.nice() == min(os.nice(0) + WORKER_NICE, 19), (
            "before it loads anything"
        )
        if sys.platform == "linux":
            assert leads_its_session(child.pid)
            assert stand_of(child.pid) == stand_of(os.getpid()).behind(WORKER_NICE)
        assert child.environ()["OMP_NUM_THREADS"] == "1"


@story
async def test_a_failure_that_it_tells_is_typed_and_the_process_lives() -> None:
    async with running() as kept:
        first = pid_of(kept)
        assert await code_of(kept.asked(unwilling=True)) == "unwilling"
        assert await code_of(kept.asked(fails="late")) == "late"
        assert await code_of(kept.asked(fails="never heard of")) == "down"
        with pytest.raises(ValueError, match="JSON"):
            await kept.asked(number_of=float("nan"))
        assert await kept.asked(b"abc") == (first, b"cba")


@pytest.mark.parametrize("one_at_a_time", [True, False])
@story
async def test_killed_or_frozen_it_fails_typed_and_comes_back(
    one_at_a_time: bool,
) -> None:
    async with running(one_at_a_time=one_at_a_time) as kept:
        first = pid_of(kept)
        os.kill(first, signal.SIGSTOP)  # so that the request is surely unanswered
        unanswered = asyncio.create_task(kept.asked())
        beside = asyncio.create_task(kept.asked())
        await asyncio.sleep(0.01)
        os.kill(first, signal.SIGKILL)
        assert await code_of(unanswered) == "died"
        if one_at_a_time:
            assert (await beside)[0] != first  # it waited, and is answered by the next
        else:
            assert await code_of(beside) == "died"
        second, _ = await kept.asked()
        assert second != first

        os.kill(second, signal.SIGSTOP)
        full = bytes(1_000_000)  # more than the pipe takes
        frozen = asyncio.create_task(kept.asked(full, 0.1 if one_at_a_time else LIMIT_S))
        await asyncio.sleep(0.01)
        late = "down" if one_at_a_time else "late"  # it is not its turn, or it is unanswered
        assert await code_of(kept.asked(timeout_s=0.02)) == late
        assert await code_of(frozen) == ("late" if one_at_a_time else "died")
        assert (await kept.asked())[0] != second
        assert not psutil.pid_exists(second)


def _is_gone(pid: int) -> bool:
    return not psutil.pid_exists(pid)


@story
async def test_unused_it_ends_without_a_word_and_the_next_request_starts_it(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async with running(rests_after_s=0.05) as kept:
        for timeout_s in (60.0, 0.01):  # a process that rested has time to start
            answered, body = await kept.asked(b"abc", timeout_s=timeout_s)
            assert body == b"cba"
            await until(partial(_is_gone, answered))
    assert not caplog.records


@story
async def test_at_work_it_does_not_rest() -> None:
    async with running(rests_after_s=0.05) as kept:
        first = pid_of(kept)
        os.kill(first, signal.SIGSTOP)
        waiting = asyncio.create_task(kept.asked(b"abc"))
        await asyncio.sleep(0.2)
        os.kill(first, signal.SIGCONT)
        assert await waiting == (first, b"cba")


@story
async def test_who_gives_up_waiting_leaves_the_next_answer_whole() -> None:
    async with running() as kept:
        first = pid_of(kept)
        os.kill(first, signal.SIGSTOP)
        given_up = asyncio.create_task(kept.asked(b"abc"))
        await asyncio.sleep(0.01)
        given_up.cancel()
        with pytest.raises(asyncio.CancelledError):
            await given_up
        os.kill(first, signal.SIGCONT)
        assert await kept.asked(b"def") == (first, b"fed")


@story
async def test_nonsense_for_an_answer_is_a_death() -> None:
    async with running() as kept:
        for act in (*SPOILS, "leaves out what was asked"):
            before = pid_of(kept)
            assert await code_of(kept.asked(spoils=act)) == "died"
            assert (await kept.asked())[0] != before
            assert not psutil.pid_exists(before)


@story
async def test_what_goes_wrong_before_the_first_word_is_no_refusal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Out of memory says nothing of what it was given."""
    monkeypatch.setattr("processes.worker.FIRST_PAUSE_S", 0.001)
    kept = Tiny(log=str(tmp_path / "starts"))
    try:
        with pytest.raises(Trouble, match=r"not ready after 0\.001 s") as caught:
            await kept.start(0.001)
        assert caught.value.code == "down"
        assert (await kept.asked())[0] == kept.pid
    finally:
        await kept.close()
    assert kept.pid is None
    assert sum("started again" in record.message for record in caplog.records) == len(SPOILS)


@story
async def test_one_that_never_says_its_first_word_is_started_again(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    kept = Tiny()
    monkeypatch.setattr(kept, "_first_word_s", 0.001)  # so none is quick enough
    try:
        assert await code_of(kept.start(1.0)) == "down"
        assert "started again in 0.05 s; its stream ended: TimeoutError()" in caplog.text
        monkeypatch.undo()
        await kept.asked()
    finally:
        await kept.close()


@story
async def test_its_own_word_is_a_refusal_for_good_even_if_it_comes_late() -> None:
    kept = Tiny(refuses="unwilling")
    assert await code_of(kept.start(0.001)) == "down"
    depths = []
    for _ in range(3):
        with pytest.raises(Trouble, match="so there") as caught:
            await kept.asked()
        assert caught.value.code == "unwilling"
        depths.append(len(caught.traceback))
    assert depths[1] == depths[2]  # nothing is piled up on it
    await kept.close()
    assert kept.pid is None


@story
async def test_who_does_not_like_its_greeting_refuses_it() -> None:
    kept = Tiny(ready="aye")
    with pytest.raises(Trouble, match="it said aye"):
        await kept.start(LIMIT_S)
    assert kept.pid is None
    assert psutil.Process().children() == []


@story
async def test_it_answers_nothing_before_its_start_and_after_its_end() -> None:
    kept = Tiny()
    assert await code_of(kept.asked()) == "down"
    await kept.start(LIMIT_S)
    child = pid_of(kept)
    await kept.close()
    await kept.close()
    assert not psutil.pid_exists(child)
    assert await code_of(kept.asked()) == "down"


@story
async def test_who_gives_up_starting_leaves_nothing() -> None:
    kept = Tiny()
    starting = asyncio.create_task(kept.start(LIMIT_S))
    await asyncio.sleep(0.01)
    starting.cancel()
    with pytest.raises(asyncio.CancelledError):
        await starting
    assert psutil.Process().children() == []


PARENT = """
import asyncio
from tests.processes.small_worker import running

async def main():
    async with running() as kept:
        print(kept.pid, flush=True)
        await kept.asked(thinks_s=60)

asyncio.run(main())
"""


def test_it_dies_with_a_parent_that_is_killed_while_it_thinks() -> None:
    command = [sys.executable, "-c", PARENT]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as parent:
        try:
            assert parent.stdout is not None
            child = int(parent.stdout.readline())
            assert psutil.pid_exists(child)
        finally:
            parent.kill()
    until_s = time.monotonic() + 5.0
    while psutil.pid_exists(child) and time.monotonic() < until_s:
        time.sleep(0.01)
    assert not psutil.pid_exists(child)
