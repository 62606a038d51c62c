"""Slices taken in processes of their own: each once, troubles told, nobody left behind."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from tests.tools.bench.test_context import lab
from tools.bench.context import MeasurementFailure
from tools.bench.parallel import SliceResult, take_in_parallel

KILLED = 2


def squared(index: int) -> int:
    if index == 1:
        raise MeasurementFailure("the robot did not come\nand did not say why")
    if index == KILLED:
        os.kill(os.getpid(), signal.SIGKILL)
    return index * index


def forever(_: int) -> None:
    time.sleep(600.0)


def test_each_is_taken_once_and_troubles_are_told() -> None:
    told = sorted(take_in_parallel(squared, range(4), 2), key=lambda done: done.index)
    assert told == [
        SliceResult(0, 0),
        SliceResult(1, trouble="Missed: the robot did not come\nand did not say why"),
        SliceResult(2, trouble="its process ended with -9"),
        SliceResult(3, 9),
    ]


def test_who_stops_asking_leaves_nobody_behind() -> None:
    begun: list[int] = []

    def indices() -> Iterator[int]:
        for index in range(9):
            begun.append(index)
            if index == 2:
                raise KeyboardInterrupt
            yield index

    with pytest.raises(KeyboardInterrupt):
        next(take_in_parallel(forever, indices(), 3))
    assert begun == [0, 1, 2]
    assert psutil.Process().children() == []


def test_a_lost_slice_is_named_and_a_resumed_run_takes_it_again(tmp_path: Path) -> None:
    bench = lab(tmp_path)
    assert sorted(bench.side_by_side("square", 4, squared)) == [0, 9]
    assert sorted(bench.lost) == [
        "square 2: Missed: the robot did not come | and did not say why",
        "square 3: its process ended with -9",
    ]
    again = lab(tmp_path)
    assert list(again.side_by_side("square", 1, forever)) == [0]
    again.end_s = 0.0
    assert sorted(again.side_by_side("square", 4, forever)) == [0, 9]
    assert again.lost == ["square 2 to 4: the time was up"]
