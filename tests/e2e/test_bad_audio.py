"""Send a running robot every bad recording: a clear no each time, memory flat, the robot still."""

from __future__ import annotations

import contextlib
import json
import math
import random
import socket
import struct
import time
from array import array
from collections.abc import Iterable

import psutil
import pytest

from tests.e2e.robot import Robot
from tests.e2e.system import Json, Reply
from tests.planner.voice.speech import wav

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]

WAV = {"Content-Type": "audio/wav"}
SECOND = bytes(32_000)
GROWN_BYTES = 40_000_000
"""More than one upload that is kept whole, far less than three of 100 MB."""
HUNDRED_MB = 100_000_000
RATE_HZ = 16_000


def header(code: int = 1, channels: int = 1, rate_hz: int = RATE_HZ, bits: int = 16) -> bytes:
    """Return a WAV file of one second's bytes whose header says so."""
    block = channels * bits // 8
    shape = struct.pack("<HHIIHH", code, channels, rate_hz, rate_hz * block, block, bits)
    pcm = SECOND[: len(SECOND) // block * block]
    chunks = b"fmt " + struct.pack("<I", 16) + shape + b"data" + struct.pack("<I", len(pcm)) + pcm
    return b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks


def lying(at: int, size: int) -> bytes:
    """Return a good file with one of its sizes replaced."""
    data = wav(SECOND)
    return data[:at] + struct.pack("<I", size) + data[at + 4 :]


REFUSED: dict[str, tuple[bytes, int, str]] = {
    "nothing": (b"", 400, "audio_empty"),
    "header only": (wav(SECOND)[:44], 400, "audio_too_short"),
    "half a header": (wav(SECOND)[:20], 400, "wav_truncated"),
    "no samples": (wav(b""), 400, "audio_too_short"),
    "mp3": (b"\xff\xfb\x90\x64" + bytes(4_000), 415, "not_wav"),
    "mp3 with a tag": (b"ID3\x04" + bytes(4_000), 415, "not_wav"),
    "ogg": (b"OggS" + bytes(4_000), 415, "not_wav"),
    "webm": (b"\x1aE\xdf\xa3" + bytes(4_000), 415, "not_wav"),
    "a page": (b"<!doctype html><title>no</title>", 415, "not_wav"),
    "floating point": (header(code=3, bits=32), 415, "wav_unsupported"),
    "mp3 in wav": (header(code=0x55), 415, "wav_unsupported"),
    "8 bits": (header(bits=8), 415, "wav_unsupported"),
    "24 bits": (header(bits=24), 415, "wav_unsupported"),
    "three channels": (header(channels=3), 415, "wav_unsupported"),
    "no channel": (lying(22, RATE_HZ << 16), 415, "wav_unsupported"),
    "1 Hz": (header(rate_hz=1), 415, "wav_unsupported"),
    "192 kHz": (header(rate_hz=192_000), 415, "wav_unsupported"),
    "16 seconds": (wav(bytes(2 * 16 * RATE_HZ)), 413, "audio_too_long"),
}


def samples(values: Iterable[float]) -> bytes:
    return wav(array("h", (int(value) for value in values)).tobytes())


def tones(*heights_hz: float, seconds: float = 4.0) -> bytes:
    """Return a chord that changes twice a second, as music does."""
    return samples(
        6_000 * sum(math.sin(2 * math.pi * h * (1 + n // 8_000 % 4 / 8) * n / RATE_HZ)
                    for h in heights_hz) / len(heights_hz)
        for n in range(int(seconds * RATE_HZ))
    )  # fmt: skip


def noise(seed: int, seconds: float = 3.0) -> bytes:
    dice = random.Random(seed)
    return samples(dice.gauss(0.0, 5_000.0) / 2 for _ in range(int(seconds * RATE_HZ)))


UNHEARD = {
    "silence": wav(SECOND * 3),
    "the longest silence": wav(SECOND * 15),
    "a constant": wav(b"\xff\x7f" * RATE_HZ),
    "white noise": noise(1),
    "other noise": noise(2),
    "one tone": tones(440.0),
    "music": tones(262.0, 330.0, 392.0, 524.0),
    "a square": samples(20_000 if n // 40 % 2 else -20_000 for n in range(2 * RATE_HZ)),
    "clicks": samples(30_000 if n % 4_000 == 0 else 0 for n in range(3 * RATE_HZ)),
}


def resident(robot: Robot) -> int:
    """Return the memory of planner and voice process [bytes]."""
    planner = robot.system.child("planner")
    total = 0
    for process in (planner, *planner.children(recursive=True)):
        with contextlib.suppress(psutil.NoSuchProcess):
            total += process.memory_info().rss
    return total


def speak(robot: Robot, data: bytes, headers: dict[str, str] = WAV) -> Reply:
    return robot.system.http("POST", "/v1/voice", data, headers, timeout_s=30.0)


def assert_told(problem: Json) -> None:
    """Hold that a person is told in both languages, and who wrote the client is told what."""
    assert problem["detail"]
    assert problem["message"]["en"].endswith(".")
    assert problem["message"]["zh"].endswith("。")


def test_bad_recordings_are_refused_and_cost_nothing(robot: Robot) -> None:
    began_s, before_goals = time.monotonic(), robot.system.goals()
    speak(robot, UNHEARD["white noise"])  # the recogniser is there from now on
    before = resident(robot)
    for _ in range(3):
        for name, (data, status, stable) in REFUSED.items():
            reply = speak(robot, data)
            assert (reply.status, reply.code) == (status, stable), name
            assert_told(reply.body)
    for kind in ("audio/ogg", "audio/mpeg", "text/plain", "multipart/form-data", ""):
        reply = speak(robot, wav(SECOND), {"Content-Type": kind})
        assert (reply.status, reply.code) == (415, "unsupported_media_type"), kind
        assert_told(reply.body)
    for _ in range(2):
        for name, data in UNHEARD.items():
            reply = speak(robot, data)
            assert reply.status == 200, (name, reply)
            assert reply.body["outcome"]["code"] == "not_heard", (name, reply.body)
            assert reply.body["goal"] is None
            assert reply.body["outcome"]["message"]["zh"].endswith("。")
    assert resident(robot) - before < GROWN_BYTES
    assert robot.system.goals() == before_goals
    robot.judge.assert_stood(began_s)


@pytest.mark.parametrize("chunked", [False, True])
def test_a_hundred_megabytes_are_cut_off(robot: Robot, chunked: bool) -> None:
    began_s = time.monotonic()
    before = most = resident(robot)
    for _ in range(3):
        status, problem, sent = flood(robot.system.port, chunked)
        most = max(most, resident(robot))
        assert (status, problem["code"]) == (413, "body_too_large")
        assert_told(problem)
        assert sent < HUNDRED_MB, "all of it was taken"
    assert most - before < GROWN_BYTES
    assert robot.system.http("GET", "/readyz").status == 200
    robot.judge.assert_stood(began_s)


def flood(port: int, chunked: bool) -> tuple[int, Json, int]:
    """Send 100 MB as fast as they are taken; return status, problem and the bytes that left."""
    size = b"Transfer-Encoding: chunked" if chunked else b"Content-Length: %d" % HUNDRED_MB
    head = b"POST /v1/voice HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Type: audio/wav\r\n" % port
    block = wav(SECOND)[:44] + bytes(65_536 - 44)
    piece = b"10000\r\n" + block + b"\r\n" if chunked else block
    sent = 0
    with socket.create_connection(("127.0.0.1", port), timeout=20.0) as line:
        line.sendall(head + size + b"\r\n\r\n")
        with contextlib.suppress(OSError):
            while sent < HUNDRED_MB:
                line.sendall(piece)
                sent += len(piece)
                line.setblocking(False)
                with contextlib.suppress(BlockingIOError):
                    if line.recv(1, socket.MSG_PEEK):
                        break
                line.settimeout(20.0)
        line.settimeout(20.0)
        answer = bytearray()
        with contextlib.suppress(OSError):
            while got := line.recv(65_536):
                answer += got
                if b"\r\n\r\n" in answer and answer.rstrip().endswith(b"}"):
                    break
    top, _, body = bytes(answer).partition(b"\r\n\r\n")
    return int(top.split()[1]), json.loads(body), sent
