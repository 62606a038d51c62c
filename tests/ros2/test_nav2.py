"""The process between Nav2 and the bridge: what comes of Nav2 is said under a grant."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ros2.nav2 import main
from tests.ros2.bridge import LIMIT_S
from tests.ros2.words import nav2_state
from tests.wire.examples import STATUS
from wire import Grant, Hello, Mode, Status, Velocity, keys
from wire.keys import Party
from wire.session import open_session
from wire.status import GrantLeft, Owner

ROBOT = """
[drive]
kind = "ros2"
[ros2]
node = "tcp/127.0.0.1:7448"
[inputs]
imu = false
"""


@pytest.fixture
def process(tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    path = tmp_path / "robot.toml"
    path.write_text(ROBOT + "[ros2.nav2]\n")
    words = ["--robot", str(path), "--home", str(tmp_path)]
    started = subprocess.Popen([sys.executable, "-m", "ros2.nav2", *words])
    yield started
    started.kill()
    started.wait(LIMIT_S)


@pytest.mark.nightly
@pytest.mark.e2e
def test_it_owns_is_granted_says_each_twist_and_falls_silent_with_nav2(
    tmp_path: Path, process: subprocess.Popen[bytes]
) -> None:
    with (
        open_session(Party.BRIDGE, "r1", tmp_path) as bridge,
        open_session(Party.ROS2, "r1", tmp_path) as ros2,
    ):
        hears = {
            key.path: bridge.subscriber(key) for key in (keys.HELLO, keys.GRANT, keys.EXTERNAL)
        }
        says, tells, seq = bridge.publisher(keys.STATUS), ros2.publisher(keys.NAV2_STATE), 0
        given: dict[str, Any] = {"owner": None, "grant": None, "held": None, "mode": Mode.HOLD}
        spoken: list[Velocity] = []
        end_s = time.monotonic() + LIMIT_S
        silent_s = float("inf")
        while time.monotonic() < min(end_s, silent_s):
            seq += 1
            status: Status = STATUS.model_copy(update=given | {"seq": seq, "map_id": "0" * 16})
            says.put(status)
            if len(spoken) < 10:
                tells.put(nav2_state(seq, 0.2, -0.1))
            elif silent_s == float("inf"):
                silent_s = time.monotonic() + 1.0
            time.sleep(0.05)
            for heard in (one for each in hears.values() for one in each.drain().items):
                if isinstance(heard, Hello):
                    given["owner"] = Owner(planner_id=heard.planner_id, kind="external")
                elif isinstance(heard, Grant):
                    given["grant"] = GrantLeft(mission=heard.mission, metres=9.0, seconds=9.0)
                elif isinstance(heard, Velocity):
                    spoken.append(heard)
        assert len(spoken) >= 10, given
        assert len(spoken) <= 12, "it says nothing of its own once Nav2 is silent"
        assert {(one.v_mps, one.w_radps, one.dead_man) for one in spoken} == {(0.2, -0.1, True)}
        process.terminate()
        assert process.wait(LIMIT_S) == 0


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "ros2_not_configured"),
        (ROBOT, "ros2_not_configured"),
        ("[ros2]\ntransport = 'carrier pigeon'", "ros2_former_keys"),
        ("[ros2]\nnode = 'carrier pigeon'", "robot_toml_invalid"),
    ],
)
def test_what_can_not_be_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, code: str
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(text)
    assert main(["--robot", str(path), "--home", str(tmp_path)]) == 2
    assert code in capsys.readouterr().err
