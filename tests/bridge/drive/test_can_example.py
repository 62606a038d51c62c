"""The example of docs/drives.md drives a base on a CAN bus as it stands there."""

from __future__ import annotations

import re
import struct
import threading
import time
from collections.abc import Callable
from typing import Any

import pytest

from bridge.drive import SerialDrive
from devices.can_line import CanFrame, CanLine, pack, unpack
from pons.settings import CHECKOUT
from wire import DriveCommand, DriveState, RobotDescription

can: Any = pytest.importorskip("can", reason="python-can is not installed: make dev")
ROBOT = RobotDescription.model_validate(
    {"base": {"wheel_radius_m": 0.1, "wheel_separation_m": 0.5, "radius_m": 0.3}}
)
LIMIT_S = 10.0


def protocol() -> Any:
    text = (CHECKOUT / "docs" / "drives.md").read_text("utf-8")
    (code,) = re.findall(r"```python\n(.*?class AgilexProtocol.*?)```", text, re.DOTALL)
    room: dict[str, Any] = {}
    exec(compile(code, "docs/drives.md", "exec"), room)  # what the page shows
    return room["AgilexProtocol"](ROBOT, "b1")


def command(seq: int, left: float, right: float, *, enable: bool = True) -> DriveCommand:
    return DriveCommand(boot="b1", seq=seq, left_radps=left, right_radps=right, enable=enable)


def test_its_bytes_are_the_manuals() -> None:
    base = protocol()
    assert unpack(base.begin()) == [CanFrame(0x421, b"\x01")]
    assert base.encode(command(1, 2.5, 3.5)) == b""
    (frame,) = unpack(base.encode(command(2, 2.5, 3.5)))
    assert frame == CanFrame(0x111, bytes.fromhex("012C00C800000000")), "0.30 m/s and 0.20 rad/s"
    (stop,) = unpack(base.encode(command(4, 2.5, 3.5, enable=False)))
    assert stop.data == bytes(8)


@pytest.mark.parametrize(("state", "mode", "ready"), [(0, 1, True), (1, 1, False), (0, 3, False)])
def test_a_base_that_a_remote_has_or_that_faults_is_a_pressed_stop(
    state: int, mode: int, ready: bool
) -> None:
    base = protocol()
    base.encode(command(8, 1.0, 1.0))
    said = [
        CanFrame(0x211, bytes([state, mode, 0, 240, 0, 0, 0, 0])),
        CanFrame(0x221, struct.pack(">hhhh", 100, 200, 0, 0)),
        CanFrame(0x311, struct.pack(">ii", 1000, -500)),
        CanFrame(0x311, b"short"),
    ]
    (heard,) = base.decode(pack(said), 10.0)
    assert isinstance(heard, DriveState)
    assert heard.estop_pressed is not ready
    assert heard.enabled is ready
    assert heard.echo_seq == (8 if ready else 0)
    assert (heard.left_rad, heard.right_rad) == pytest.approx((10.0, -5.0))
    assert (heard.left_radps, heard.right_radps) == pytest.approx((0.5, 1.5))


class Base(threading.Thread):
    """Be an AgileX on the bus: obey 0x111, count millimetres, stop 0.5 s after the last frame."""

    def __init__(self, channel: str) -> None:
        super().__init__(daemon=True)
        self.bus = can.Bus(channel=channel, interface="virtual")
        self.ending = threading.Event()
        self.heard_s, self.v_mps, self.way_mm, self.mode = 0.0, 0.0, 0.0, 0

    def run(self) -> None:
        last_s = time.monotonic()
        while not self.ending.is_set():
            message = self.bus.recv(0.01)
            now_s = time.monotonic()
            if message is not None and message.arbitration_id == 0x421:
                self.mode = message.data[0]
            elif message is not None and message.arbitration_id == 0x111 and self.mode == 1:
                self.heard_s, self.v_mps = now_s, struct.unpack(">h", message.data[:2])[0] / 1000
            if now_s - self.heard_s > 0.5:
                self.v_mps = 0.0
            self.way_mm += 1000 * self.v_mps * (now_s - last_s)
            last_s = now_s
            self.say(0x211, bytes([0, self.mode, 0, 240, 0, 0, 0, 0]))
            self.say(0x221, struct.pack(">hhhh", round(1000 * self.v_mps), 0, 0, 0))
            self.say(0x311, struct.pack(">ii", round(self.way_mm), round(self.way_mm)))
        self.bus.shutdown()

    def say(self, number: int, data: bytes) -> None:
        self.bus.send(can.Message(arbitration_id=number, data=data, is_extended_id=False))


def test_it_drives_a_base_on_a_bus_and_silence_stops_it() -> None:
    base = Base("agilex-example")
    base.start()
    line = CanLine("agilex-example", "virtual")
    drive = SerialDrive(protocol(), line, "b1")
    newest: list[DriveState] = []
    seq = 0

    def tick(radps: float | None) -> None:
        nonlocal seq
        seq += 1
        drive.write(None if radps is None else command(seq, radps, radps))
        newest.extend(one for one in drive.read() if isinstance(one, DriveState))
        time.sleep(0.005)

    def until(done: Callable[[], bool], radps: float | None) -> None:
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, newest[-1:]
            tick(radps)

    try:
        until(lambda: bool(newest) and newest[-1].left_rad > 1.0, 3.0)
        assert newest[-1].left_radps == pytest.approx(3.0, abs=0.01)
        assert newest[-1].enabled
        assert newest[-1].echo_seq > 0
        assert drive.take_imu() is None
        until(lambda: newest[-1].left_radps == 0.0, None)
    finally:
        drive.close()
        base.ending.set()
        base.join()
