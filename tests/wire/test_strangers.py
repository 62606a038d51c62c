"""Who knocks at a door says what that door hears, to its listener alone, in any zenoh mode."""

from __future__ import annotations

import json
import time
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
import zenoh

from tests.wire.examples import EXAMPLES
from wire import encode
from wire.doors import BRIDGE_DOOR, CAMERA_DOOR, DOORS, Door
from wire.keys import KEYS, STATUS, STOP, Party
from wire.session import Session, open_session
from wire.sockets import Endpoints

LIMIT_S = 10.0
QUIET_S = 0.3


def stranger(mode: str, locator: str, *, listens: bool = False) -> Any:
    """Dial, or listen, as zenoh comes, without our access control."""
    config = zenoh.Config()
    settings = {
        "mode": mode,
        "connect/endpoints": [] if listens else [locator],
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    if mode != "client":
        settings["listen/endpoints"] = [locator] if listens else []
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return zenoh.open(config)


def everything(links: dict[Door, Any]) -> dict[str, list[Any]]:
    """Hear every key on every link of a process, past its own subscribers."""
    return {
        door.name: [
            link.declare_subscriber(key.expression("r1"), zenoh.handlers.RingChannel(64))
            for key in KEYS
        ]
        for door, link in links.items()
    }


def heard(ears: dict[str, list[Any]]) -> set[tuple[str, str]]:
    found = set()
    for door, subscribers in ears.items():
        for subscriber in subscribers:
            while (sample := subscriber.try_recv()) is not None:
                found.add((door, str(sample.key_expr).removeprefix("pons/r1/")))
    return found


@pytest.mark.parametrize(
    ("door", "mode"),
    [(door, "client") for door in DOORS] + [(BRIDGE_DOOR, "peer"), (BRIDGE_DOOR, "router")],
    ids=lambda one: one.name if isinstance(one, Door) else one,
)
def test_a_stranger_reaches_the_listener_of_one_door_with_what_it_hears(
    door: Door, mode: str
) -> None:
    parties = [door.listener, *(one for one in Party if one is not door.listener)]
    with ExitStack() as stack:
        # pytest's own folder, named by this test, is too long for a socket's path
        home = Path(stack.enter_context(TemporaryDirectory(prefix="pons-")))
        sessions: dict[Party, Session] = {
            party: stack.enter_context(open_session(party, "r1", home)) for party in parties
        }
        listener = sessions[door.listener]
        end_s = time.monotonic() + LIMIT_S
        while listener.peers() < len(door.dialled_by) and time.monotonic() < end_s:
            time.sleep(0.01)
        ears = {party: everything(session._links) for party, session in sessions.items()}
        other = stack.enter_context(stranger(mode, Endpoints(home).locator(door)))
        expected = {(door.name, key.path) for key in door.hears}
        got: dict[Party, set[tuple[str, str]]] = {party: set() for party in parties}

        def listen() -> None:
            for party in parties:
                got[party] |= heard(ears[party])

        def shout() -> None:
            for key in KEYS:
                other.put(key.expression("r1"), encode(EXAMPLES[key.message]))
                other.delete(key.expression("r1"))
            other.put("pons/**", b"{}")
            other.put("**", b"{}")

        while not got[door.listener] >= expected and time.monotonic() < end_s:
            shout()
            listen()
            time.sleep(0.01)
        for _ in range(5):
            shout()
        time.sleep(QUIET_S)  # what is relayed comes later; nothing tells that it will not
        listen()
    assert got.pop(door.listener) == expected
    assert {party: all_of for party, all_of in got.items() if all_of} == {}


def test_who_takes_an_absent_cameras_place_says_pictures_and_nothing_else(tmp_path: Path) -> None:
    """On a robot without a camera the planner dials that door for ever."""
    path = Endpoints(tmp_path).socket(CAMERA_DOOR)
    path.parent.mkdir(parents=True)
    locator = Endpoints(tmp_path).locator(CAMERA_DOOR)
    with (
        stranger("peer", locator, listens=True) as other,
        open_session(Party.PLANNER, "r1", tmp_path) as planner,
    ):
        ears, found = everything(planner._links), set[tuple[str, str]]()
        status = planner.subscriber(STATUS)
        end_s = time.monotonic() + LIMIT_S
        pictures = {("camera", key.path) for key in CAMERA_DOOR.says}
        while not found >= pictures and time.monotonic() < end_s:
            for key in KEYS:
                other.put(key.expression("r1"), encode(EXAMPLES[key.message]))
            time.sleep(0.01)
            found |= heard(ears)
        time.sleep(QUIET_S)
        assert found | heard(ears) == pictures
        assert status.newest() is None


def test_without_access_control_a_client_would_be_relayed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Be the negative control: zenoh itself passes a client's words on, and this test sees it."""
    monkeypatch.setattr("wire.session.access_control", lambda *_: {"enabled": False})
    with (
        open_session(Party.BRIDGE, "r1", tmp_path),
        open_session(Party.PLANNER, "r1", tmp_path) as planner,
    ):
        ears = everything({BRIDGE_DOOR: planner._links[BRIDGE_DOOR]})
        with stranger("client", Endpoints(tmp_path).locator(BRIDGE_DOOR)) as other:
            end_s = time.monotonic() + LIMIT_S
            found: set[tuple[str, str]] = set()
            while ("bridge", "bridge/status") not in found and time.monotonic() < end_s:
                other.put("pons/r1/bridge/status", b"{}")
                time.sleep(0.01)
                found |= heard(ears)
    assert ("bridge", "bridge/status") in found


def test_a_process_may_not_declare_what_none_of_its_doors_carries(tmp_path: Path) -> None:
    with open_session(Party.CAMERA, "r1", tmp_path) as camera:
        with pytest.raises(ValueError, match=r"cmd/stop passes none of the camera doors"):
            camera.publisher(STOP)
        with pytest.raises(ValueError, match=r"cmd/stop passes none"):
            camera.subscriber(STOP)
