"""Each drive is set beside the simulated one of its own round, and its bytes go through a pty."""

from __future__ import annotations

import pytest

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from tools.bench.measure.drive_lateness import MESSAGES, ROBOTS, SIMULATED, tick_rows, write_ms
from wire import load_robot


def test_each_kind_of_drive_has_its_robot_and_each_with_a_line_its_command() -> None:
    assert set(MESSAGES) == set(SERIAL_PROTOCOLS)
    assert {load_robot(path).drive.kind for path in ROBOTS.values()} == {*MESSAGES, "sim", "ros2"}


@pytest.mark.parametrize("kind", MESSAGES)
def test_every_command_comes_through_whole(kind: str) -> None:
    assert len(write_ms(kind, 5)) == 5


def test_what_a_round_does_to_all_drives_is_taken_off() -> None:
    rounds = [{kind: [50.0 + slow] for kind in ROBOTS} for slow in (0.0, 100.0)]
    rounds[0]["arduino"], rounds[1]["arduino"] = [57.0], [157.0]
    notes = {row.what: (row.goal, row.note) for row in tick_rows(rounds)}
    assert notes[f"{SIMULATED}: median of a slice"] == ("", "above the simulated one, median: 0")
    goal, note = notes["arduino: median of a slice"]
    assert goal == "above it <= 100, its spread"
    assert note == "above the simulated one, median: 7"
