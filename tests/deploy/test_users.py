"""Who could say what on a robot whose processes have users of their own, tried by each of them.

Folders and groups are those that tmpfiles.d and sysusers.d make; a hostile process under each user,
and under a stranger's, knocks at every door, in zenoh's client mode too, says every key there and
tries to take the listener's place. Needs root; prints the table.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.deploy.deployed_users import (
    BRIDGE,
    SIM,
    USERS,
    folders,
    groups_of,
    home_as_deployed,
    numbers_of,
)
from tests.deploy.installed import ROOT
from tests.known import known
from wire.doors import BRIDGE_DOOR, DOORS, Door
from wire.keys import Party

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.timeout(180),
    pytest.mark.skipif(os.geteuid() != 0, reason="only root may become the users of a robot"),
    pytest.mark.nightly,
]

PARTIES = {
    Party.BRIDGE: "pons-bridge",
    Party.ROBOT: "pons-sim",
    Party.LOCALIZATION: "pons-localization",
    Party.CAMERA: "pons-camera",
    Party.LIDAR: "pons-lidar",
    Party.ROS2: "pons-ros2",
    Party.IMU: "pons-imu",
    Party.PLANNER: "pons-planner",
    Party.OPERATOR: "pons-planner",
}
READY_S = 60.0


def as_user(user: str, *words: str) -> list[str]:
    start = [sys.executable, "-m", "tests.as_user", *numbers_of(user)]
    return [*start, "tests.deploy.knock", *words]


class Hearer(threading.Thread):
    """Be a party of the robot under its user and keep what hostile processes told it."""

    def __init__(self, party: Party, home: Path) -> None:
        super().__init__(daemon=True)
        self.lines: list[str] = []
        self.ready = threading.Event()
        self.process = subprocess.Popen(
            as_user(PARTIES[party], "hear", party.value, str(home)),
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=ROOT,
        )  # fmt: skip
        self.start()

    def run(self) -> None:
        for line in known(self.process.stdout):
            if line == "ready\n":
                self.ready.set()
            else:
                self.lines.append(line.strip())

    def close(self) -> None:
        self.process.communicate()
        self.join()

    def heard(self) -> set[tuple[str, str, str]]:
        """Return user, door and key of all that hostile processes made it hear."""
        return {(user, door, key) for user, door, key in (line.split() for line in self.lines)}


def expected(user: str, door: Door) -> set[str]:
    """Return the keys that a user may say at a door: all that it hears, to who may enter."""
    group = folders()[f"/var/lib/pons/run/{door.name}"][2]
    return {key.path for key in door.hears} if group in groups_of(user) else set()


def test_each_user_says_what_its_groups_let_it_and_takes_nobodys_place(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with home_as_deployed() as home, ExitStack() as stack:
        hearers = {party: Hearer(party, home) for party in PARTIES}
        for hearer in hearers.values():
            stack.callback(hearer.close)
        for party, hearer in hearers.items():
            assert hearer.ready.wait(READY_S), party
        knocking = {
            user: subprocess.Popen(
                as_user(user, "knock", user, str(home)), stdout=subprocess.PIPE, text=True, cwd=ROOT
            )
            for user in USERS
            if user not in (BRIDGE, SIM)  # they own wheels and orders as it is
        }
        came = {user: json.loads(process.communicate()[0]) for user, process in knocking.items()}
        time.sleep(0.5)  # what is relayed comes later; nothing tells that it will not
        heard = {party: hearer.heard() for party, hearer in hearers.items()}
    table = rows(came, heard)
    with capsys.disabled():
        print("\n" + "\n".join(table))
    for user, doors in came.items():
        for door in (door for door in DOORS if door.name in doors):
            group = folders()[f"/var/lib/pons/run/{door.name}"][2]
            assert doors[door.name] == {"in": group in groups_of(user), "took": []}, (
                user,
                door.name,
            )
            all_of = heard[door.listener]
            said = {key for who, where, key in all_of if (who, where) == (user, door.name)}
            assert said == expected(user, door), (user, door.name)
    for party, all_of in heard.items():  # nobody hears at all what was said at another's door
        listens = {door.name for door in DOORS if door.listener is party}
        assert {one for one in all_of if one[1] not in listens} == set(), party


def test_what_the_planners_user_may_say_is_what_the_bridge_lets_anybody_ask() -> None:
    """The law that the table above shows, from the files alone; and poses: its own, and a goal."""
    said = {key for door in DOORS for key in expected("pons-planner", door)}
    beside = {"loc/hint", "nav2/goal", "plan/view"}
    assert said == {key.path for key in BRIDGE_DOOR.hears} | beside
    assert all(key.startswith(("cmd/", "op/")) for key in said - beside - {"trial/order"})
    assert "op/estop_link" not in said
    assert {key for door in DOORS for key in expected("stranger", door)} == set()


def rows(
    came: dict[str, dict[str, dict[str, object]]], heard: dict[Party, set[tuple[str, str, str]]]
) -> list[str]:
    lines = ["| user | door | may connect | what of it was heard, by whom |", "|---|---|---|---|"]
    for user, doors in came.items():
        for name, one in doors.items():
            got = []
            for party, all_of in heard.items():
                keys = sorted(key for who, at, key in all_of if (who, at) == (user, name))
                got += [f"{party}: {', '.join(keys)}"] if keys else []
            may = "yes" if one["in"] else "no"
            lines.append(f"| {user} | {name} | {may} | {'; '.join(got) or 'nothing'} |")
    return lines
