"""Each pair of the key table meets at one door, and no door lets anything else pass."""

from __future__ import annotations

import pytest

from wire import Record
from wire.doors import DOORS, Door, doors_of
from wire.keys import (
    CAMERA_COLOR,
    DRIVE_COMMAND,
    DRIVE_STATE,
    ESTOP_LINK,
    IMU,
    KEYS,
    LOCALIZATION,
    SCAN,
    STOP,
    Key,
    Party,
)
from wire.sockets import MAX_SOCKET_PATH

SENSES = (LOCALIZATION, DRIVE_STATE, SCAN, IMU, ESTOP_LINK)
"""What the bridge drives by."""
NEVER_TRUSTED = (Party.PLANNER, Party.OPERATOR, Party.JUDGE, Party.CAMERA)


def passed(sender: Party, receiver: Party, key: Key[Record]) -> list[Door]:
    return [
        door
        for door in doors_of(sender)
        if door in doors_of(receiver)
        and door.outward(sender, key.path)
        and door.inward(receiver, key.path)
    ]


@pytest.mark.parametrize("key", KEYS, ids=lambda key: key.path)
def test_every_pair_of_a_key_meets_at_one_door(key: Key[Record]) -> None:
    """Nobody relays, so a pair without a door would never receive; with two it would hear twice."""
    pairs = [(s, r) for s in key.senders for r in key.receivers if s != r]
    assert pairs
    assert [pair for pair in pairs if len(passed(*pair, key)) != 1] == []


@pytest.mark.parametrize("door", DOORS, ids=lambda door: door.name)
def test_no_door_lets_pass_what_the_key_table_does_not_name(door: Door) -> None:
    assert door.listener not in door.dialled_by
    for key in door.hears:
        assert door.listener in key.receivers
        assert key.senders & set(door.dialled_by), key.path
    for key in door.says:
        assert door.listener in key.senders
        assert key.receivers & set(door.dialled_by) or key is STOP, key.path
    assert not {key.path for key in door.hears} & {key.path for key in door.says}


@pytest.mark.parametrize("key", SENSES, ids=lambda key: key.path)
def test_what_the_bridge_drives_by_comes_in_where_neither_planner_nor_operator_knocks(
    key: Key[Record],
) -> None:
    inward = [door for door in doors_of(Party.BRIDGE) if door.inward(Party.BRIDGE, key.path)]
    assert len(inward) == len(key.senders), "one door for each of those who measure it"
    for door in inward:
        assert not set(NEVER_TRUSTED) & {door.listener, *door.dialled_by}


def test_only_the_bridge_may_reach_the_wheels() -> None:
    doors = doors_of(Party.ROBOT)
    inward = [door for door in doors if door.inward(Party.ROBOT, DRIVE_COMMAND.path)]
    assert [(door.name, door.dialled_by) for door in inward] == [("drive", (Party.BRIDGE,))]


def test_a_stop_is_heard_at_every_door_of_the_bridge() -> None:
    for door in doors_of(Party.BRIDGE):
        assert door.inward(Party.BRIDGE, STOP.path), door.name


def test_who_is_only_looked_at_hears_nothing() -> None:
    for door in doors_of(Party.PLANNER):
        assert door.name in ("bridge", "hint", "nav2") or not door.hears
    nav2 = next(door for door in DOORS if door.name == "nav2")
    assert [key.path for key in nav2.hears] == ["nav2/goal", "plan/view"], "no velocity"
    assert nav2.dialled_by == (Party.PLANNER, Party.JUDGE)
    hint = next(door for door in DOORS if door.name == "hint")
    assert ([key.path for key in hint.hears], hint.says) == (["loc/hint"], ())
    assert hint.dialled_by == (Party.PLANNER,), "nobody else says where the robot is"
    doors = doors_of(Party.PLANNER)
    camera = next(door for door in doors if door.inward(Party.PLANNER, CAMERA_COLOR.path))
    assert {key.path for key in camera.says} == {"camera/color", "camera/depth", "camera/state"}


def test_the_longest_socket_leaves_room_for_a_home() -> None:
    longest = max(len(f"/run/{door.name}/{door.name}.sock") for door in DOORS)
    assert MAX_SOCKET_PATH - longest >= 70
