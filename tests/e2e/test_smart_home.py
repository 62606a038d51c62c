"""A smart home orders and stops the robot by MQTT; an hour of orders at once moves nothing."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from paho.mqtt import publish, subscribe
from paho.mqtt.client import MQTTv5

from tests.e2e.polling import until
from tests.e2e.robot import STOP_LIMIT_S, Robot
from tests.pons.mqtt.broker import PASSWORD, USER, Broker

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

QUIET_S = 4.0
"""Longer than a burst's orders wait, and than the gateway is deaf after it."""


class Home:
    """Be the home's side of the broker."""

    def __init__(self, broker: Broker) -> None:
        self._at: dict[str, Any] = {
            "hostname": "127.0.0.1", "port": broker.port, "protocol": MQTTv5,
            "auth": {"username": USER, "password": PASSWORD},
            "tls": {"ca_certs": str(broker.ca_file)},
        }  # fmt: skip

    def say(self, *orders: tuple[str, str]) -> None:
        """Publish orders on one connection, as fast as it goes."""
        publish.multiple(
            [{"topic": f"pons/r1/{word}", "payload": text, "qos": 1} for word, text in orders],
            **self._at,
        )

    def newest(self, word: str) -> str:
        """Return what the broker keeps of a topic."""
        message = subscribe.simple(f"pons/r1/{word}", **self._at)  # type: ignore[no-untyped-call]
        return str(message.payload.decode())


@pytest.fixture(scope="module")
def homes() -> Iterator[tuple[Robot, Home]]:
    folders = [TemporaryDirectory(prefix=f"pons-{name}-") for name in ("e2e", "broker")]
    with folders[0] as name, folders[1] as apart, Broker(Path(apart)) as broker:
        (Path(name) / "settings.toml").write_text(broker.table(Path(name)))
        robot = Robot(Path(name))
        robot.start()
        yield robot, Home(broker)
        robot.close()


def test_rooms_are_driven_through_and_a_stop_needs_no_planner(homes: tuple[Robot, Home]) -> None:
    robot, home = homes
    robot.rest()
    until(lambda: '"segments"' in home.newest("state"), 20.0, "the rooms", robot.system.logs)
    room = max((place for place in robot.site.places if place.kind == "room"), key=robot.away_m).id
    home.say(("segments", f'["{room}"]'))
    robot.judge.until_moving()
    robot.system.freeze("planner")
    home.say(("stop", "PRESS"))
    robot.judge.until_standing(STOP_LIMIT_S)
    robot.system.thaw("planner")
    until(lambda: '"paused"' in home.newest("state"), 10.0, "paused", robot.system.logs)


def test_an_hour_of_orders_at_once_moves_nothing(homes: tuple[Robot, Home]) -> None:
    robot, home = homes
    robot.rest()
    before, begun_s = len(robot.system.goals()), time.monotonic()
    orders = [("sentence", "go home"), ("command", "start"), ("segments", '["left"]')]
    home.say(*orders * 100)
    time.sleep(QUIET_S)
    assert robot.judge.path_m(begun_s) < 0.01
    assert len(robot.system.goals()) == before
