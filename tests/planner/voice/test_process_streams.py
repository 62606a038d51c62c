"""The recordings that a voice process follows: each has a listener of its own, and few are kept."""

from __future__ import annotations

from collections import OrderedDict

from planner.voice import Recognition
from planner.voice.process_main import MOST_STREAMS, PartListener, _answer


class Counts:
    """Say how many bytes came of one recording."""

    def __init__(self) -> None:
        self.taken = 0

    def take(self, pcm: bytes) -> Recognition | None:
        self.taken += len(pcm)
        if pcm == b"!!":
            raise IndexError("a token that the file lacks")
        return Recognition(str(self.taken), 0.9, understood=True) if pcm else None


class CountingEngine:
    def hear(
        self, pcm: bytes, rate_hz: int, channels: int, *, awaits_answer: bool = False
    ) -> Recognition:
        return Recognition("whole", 0.9, understood=awaits_answer)

    def listener(self, rate_hz: int, channels: int) -> PartListener:
        return Counts()


def ask(streams: OrderedDict[int, PartListener], number: int, pcm: bytes) -> dict[str, object]:
    head = {"rate_hz": 16_000, "channels": 1, "stream": number}
    return _answer(CountingEngine(), streams, (head, pcm))[0]


def test_each_recording_is_followed_alone() -> None:
    streams: OrderedDict[int, PartListener] = OrderedDict()
    told = [ask(streams, number, b"ab")["transcript"] for number in (1, 2, 1, 1, 2)]
    assert told == ["2", "2", "4", "6", "4"]


def test_the_one_that_was_fed_longest_ago_is_forgotten() -> None:
    streams: OrderedDict[int, PartListener] = OrderedDict()
    for number in range(MOST_STREAMS):
        ask(streams, number, b"ab")
    ask(streams, 0, b"ab")
    ask(streams, MOST_STREAMS, b"ab")
    assert len(streams) == MOST_STREAMS
    assert ask(streams, 0, b"ab")["transcript"] == "6"
    assert ask(streams, 1, b"ab")["transcript"] == "2"


def test_nothing_heard_and_a_failure_are_told_as_such() -> None:
    streams: OrderedDict[int, PartListener] = OrderedDict()
    assert ask(streams, 1, b"")["understood"] is False
    assert "IndexError" in str(ask(streams, 1, b"!!")["failed"])
    whole = {"rate_hz": 16_000, "channels": 1, "awaits_answer": True}
    assert _answer(CountingEngine(), streams, (whole, b""))[0]["understood"] is True
