"""The connection sends nothing that would wait, and leaves a server that says nothing."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

import pytest

from pons.robot_processes import free_port
from ros2 import BaseLink, LinkMessages
from ros2.connection import SILENT_S, RosbridgeConnection
from ros2.operations import AskType, Subscribe
from sim.twin.rosbridge_server import RosbridgeServer
from tests.ros2.frames import TYPES, robot

LIMIT_S = 10.0


async def until(done: Callable[[], bool]) -> None:
    end_s = time.monotonic() + LIMIT_S
    while not done():
        assert time.monotonic() < end_s
        await asyncio.sleep(0.005)


def connection(port: int) -> tuple[RosbridgeConnection, BaseLink, list[LinkMessages]]:
    link, heard = BaseLink(robot(), "r"), list[LinkMessages]()
    return RosbridgeConnection(f"ws://127.0.0.1:{port}", link, heard.append), link, heard


def code_of(link: BaseLink) -> str | None:
    trouble = link.judge(time.monotonic())
    return trouble.code if trouble else None


def test_without_a_server_nothing_is_sent_and_it_is_dialled_for_ever() -> None:
    async def play() -> None:
        made, link, _ = connection(free_port())
        serving = asyncio.create_task(made.serve())
        await until(lambda: code_of(link) == "ros2_no_server")
        assert not made.has_room()
        assert not await made.send(AskType("/odom"))
        await made.drop_if_silent(1e9)
        assert not serving.done()
        serving.cancel()

    asyncio.run(play())


def test_what_the_server_says_is_heard_and_one_that_is_silent_is_dialled_anew() -> None:
    server = RosbridgeServer(0, dict(TYPES))

    async def play() -> None:
        made, link, heard = connection(server.port)
        serving = asyncio.create_task(made.serve())
        await until(made.has_room)
        for frame in link.due(time.monotonic()):
            assert await made.send(frame)
        await until(lambda: len(heard) == len(TYPES))
        await made.drop_if_silent(time.monotonic())
        assert link.reached == 1
        await made.drop_if_silent(time.monotonic() + SILENT_S + 1.0)
        await until(lambda: link.reached == 2)
        serving.cancel()

    asyncio.run(play())
    server.close()


def test_a_message_longer_than_is_wanted_ends_the_connection_and_is_named() -> None:
    server = RosbridgeServer(0, dict(TYPES))

    async def play() -> None:
        link, heard = BaseLink(robot(), "r"), list[LinkMessages]()
        made = RosbridgeConnection(f"ws://127.0.0.1:{server.port}", link, heard.append, 4096)
        serving = asyncio.create_task(made.serve())
        await until(made.has_room)
        assert await made.send(Subscribe("/odom", TYPES["/odom"]))
        while code_of(link) != "ros2_message_too_large":
            server.publish("/odom", {"data": "x" * 5000})
            await asyncio.sleep(0.01)
        serving.cancel()

    asyncio.run(asyncio.wait_for(play(), LIMIT_S))
    server.close()


@pytest.mark.parametrize("answer", [b"HTTP/1.1 404 Not Found\r\n\r\n", b"SSH-2.0-x\r\n", b""])
def test_what_is_no_websocket_is_no_server(answer: bytes) -> None:
    async def play() -> None:
        async def attend(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            await reader.readuntil(b"\r\n\r\n")
            writer.write(answer)
            writer.close()

        other = await asyncio.start_server(attend, "127.0.0.1", 0)
        made, link, _ = connection(other.sockets[0].getsockname()[1])
        serving = asyncio.create_task(made.serve())
        await until(lambda: code_of(link) == "ros2_no_server")
        serving.cancel()
        other.close()

    asyncio.run(play())
