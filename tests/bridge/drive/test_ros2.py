"""The drive of a ROS 2 base speaks as the simulator's does, and is metal."""

from __future__ import annotations

from typing import cast

from bridge.drive import Drive, Ros2Drive, SimDrive, require_brakes
from tests.wire.examples import EXAMPLES
from wire import encode
from wire.keys import DRIVE_STATE
from wire.session import Session


class Line:
    """Stand for both ends of a session."""

    def __init__(self) -> None:
        self.said: list[object] = []

    def publisher(self, _key: object) -> Line:
        return self

    subscriber = publisher

    def put(self, message: object) -> None:
        self.said.append(message)

    def drain_bytes(self) -> list[bytes]:
        return [encode(EXAMPLES[DRIVE_STATE.message])]


def test_it_is_metal_that_brakes_and_is_no_kind_of_simulator() -> None:
    drive: Drive = Ros2Drive(cast("Session", Line()), "boot1")
    assert (drive.kind, drive.virtual) == ("ros2", False)
    assert require_brakes(drive) is drive
    assert (SimDrive.kind, SimDrive.virtual) == ("sim", True)


def test_it_reads_writes_and_halts_over_the_wire() -> None:
    line = Line()
    drive = Ros2Drive(cast("Session", line), "boot1")
    assert drive.read() == (EXAMPLES[DRIVE_STATE.message],)
    drive.write(None)
    assert line.said == []
    drive.halt()
    assert line.said
