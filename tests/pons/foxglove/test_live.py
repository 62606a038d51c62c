"""Foxglove is shown what the bus says, in its own schemas; nobody waits for a window."""

from __future__ import annotations

import asyncio
import base64
import json
import struct
from collections import Counter
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from websockets.asyncio.client import ClientConnection, connect

from pons.foxglove import scene
from pons.foxglove.layout import layout
from pons.foxglove.live import LiveView
from pons.foxglove.topics import LiveTopic
from pons.robot_processes import free_port
from pons.settings import CHECKOUT, LaunchSettings
from tests.pons.standing_bridge import StandingBridge
from tests.wire.examples import EXAMPLES
from wire import Pose2, Status, load_robot
from wire.sensors import Scan

LIMIT_S = 30.0
FROM_THE_BRIDGE = {
    LiveTopic.TRANSFORMS,
    LiveTopic.POSE,
    LiveTopic.SPEEDS,
    LiveTopic.TICKS,
    LiveTopic.ROWS,
}


@asynccontextmanager
async def viewer(port: int) -> AsyncIterator[tuple[ClientConnection, dict[int, str]]]:
    """Be a Foxglove window that has subscribed to every topic that was offered."""
    url = f"ws://127.0.0.1:{port}"
    async with connect(url, subprotocols=["foxglove.sdk.v1"], compression=None) as socket:  # type: ignore[list-item]
        while True:
            said = json.loads(await socket.recv())
            if said["op"] == "advertise":
                break
        offered = {channel["id"]: channel for channel in said["channels"]}
        subscriptions = [{"id": number, "channelId": number} for number in offered]
        await socket.send(json.dumps({"op": "subscribe", "subscriptions": subscriptions}))
        yield socket, {number: channel["topic"] for number, channel in offered.items()}


@asynccontextmanager
async def shown() -> AsyncIterator[int]:
    """Show a robot of which only a standing bridge is there."""
    with TemporaryDirectory(prefix="pons-fox-") as name:
        home, robot, port = Path(name), load_robot(CHECKOUT / "robot.toml"), free_port()
        settings = LaunchSettings(home, CHECKOUT / "robot.toml", home, "127.0.0.1", free_port())
        with StandingBridge(home, robot.id):
            serving = asyncio.create_task(LiveView(settings, robot).serve(port))
            try:
                for _ in range(round(LIMIT_S / 0.05)):
                    await asyncio.sleep(0.05)
                    if serving.done():
                        serving.result()
                    try:
                        _, writer = await asyncio.open_connection("127.0.0.1", port)
                    except OSError:
                        continue
                    writer.close()
                    break
                yield port
            finally:
                serving.cancel()
                await asyncio.gather(serving, return_exceptions=True)


def test_a_window_is_shown_what_the_bridge_says_without_a_planner() -> None:
    async def story() -> None:
        seen: Counter[str] = Counter()
        async with shown() as port, viewer(port) as (socket, topics), asyncio.timeout(LIMIT_S):
            assert set(topics.values()) == set(LiveTopic)
            async for message in socket:
                if isinstance(message, bytes):
                    _, number = struct.unpack_from("<BI", message, 0)
                    seen[topics[number]] += 1
                if set(seen) >= FROM_THE_BRIDGE:
                    return

    asyncio.run(story())


@pytest.mark.nightly
def test_a_window_that_never_reads_stands_in_nobodys_way() -> None:
    async def story() -> None:
        async with shown() as port, viewer(port), viewer(port) as (socket, topics):
            told: Counter[str] = Counter()
            async with asyncio.timeout(LIMIT_S):
                async for message in socket:
                    if isinstance(message, bytes):
                        told[topics[struct.unpack_from("<BI", message, 0)[1]]] += 1
                    if told[LiveTopic.SPEEDS] >= 20:
                        return

    asyncio.run(story())


def test_the_layout_names_topics_and_panels_that_are_there() -> None:
    made = layout()
    text = json.dumps(made)
    for topic in (
        LiveTopic.SCAN,
        LiveTopic.MAP,
        LiveTopic.ROUTE,
        LiveTopic.CAMERA,
        LiveTopic.BOXES,
        LiveTopic.LOG,
    ):
        assert f'"{topic}"' in text

    def panels(node: str | dict[str, Any]) -> list[str]:
        if isinstance(node, str):
            return [node]
        return panels(node["first"]) + panels(node["second"])

    assert sorted(panels(made["layout"])) == sorted(made["configById"])
    for plot in (config for name, config in made["configById"].items() if name[:4] == "Plot"):
        for path in plot["paths"]:
            topic, _, field = path["value"].partition(".")
            make = scene.speeds if topic == LiveTopic.SPEEDS else scene.ticks
            assert field in make(status())


def status(**more: Any) -> Status:
    example = EXAMPLES[Status]
    assert isinstance(example, Status)
    return example.model_copy(update=more)


def test_a_lost_robot_has_no_pose_in_the_map() -> None:
    assert scene.pose(status(base_in_map=None)) is None
    lost = repr(scene.transforms(status(base_in_map=None)))
    known = repr(scene.transforms(status(base_in_map=Pose2(1.0, 2.0, 0.5))))
    assert "map" not in lost
    assert "map" in known


def test_beams_without_an_echo_and_too_near_ones_are_no_numbers() -> None:
    example = EXAMPLES[Scan]
    assert isinstance(example, Scan)
    said = example.model_copy(update={"ranges_m": (1.0, None, 0.001), "range_min_m": 0.1})
    made = repr(scene.scan(said, load_robot(CHECKOUT / "robot.toml").lidar))
    assert made.lower().count("nan") == 2


def test_a_map_is_told_as_occupancy() -> None:
    told = {
        "cells": base64.b64encode(bytes((0, 1, 2, 0))).decode(), "width": 2, "height": 2,
        "resolution_m": 0.05, "origin": {"x_m": -1.0, "y_m": 0.0},
    }  # fmt: skip
    made = scene.grid(told).encode()
    assert bytes((0, 100, 255, 0)) in made


@pytest.mark.parametrize(
    ("made", "parts"),
    [
        (scene.route({"points": [[0.0, 1.0], [2.0, 3.0]]}).encode(), [b"map"]),
        (scene.route(None).encode(), [b"map"]),
        (
            scene.fence({"allowed": [[[0, 0], [1, 0], [1, 1]]], "keep_outs": [],
                         "speed_zones": [{"polygon": [[0, 0], [1, 0], [1, 1]]}]}).encode(),
            [b"allowed 0", b"slow 0"],
        ),
        (
            scene.places([{"id": "kitchen", "name": {"en": None}, "polygon": None,
                           "pose": {"x_m": 1.0, "y_m": 2.0}}]).encode(),
            [b"kitchen"],
        ),
        (
            scene.things([{"id": 7, "name": {"en": "red ball"}, "x_m": 1, "y_m": 2, "z_m": 0}])
            .encode(),
            [b"red ball"],
        ),
        (
            scene.boxes({"boxes": [{"box": [1, 2, 3, 4], "score": 0.9, "name": {"en": "cup"}}]})
            .encode(),
            [b"cup 0.90"],
        ),
        (scene.boxes(None).encode(), []),
    ],
)  # fmt: skip
def test_what_the_planner_knows_is_drawn(made: bytes, parts: list[bytes]) -> None:
    assert all(part in made for part in parts)
