"""The gateway's process at a real broker, beside a bridge and without a planner."""

from __future__ import annotations

import asyncio
import json
import ssl
import subprocess
import sys
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import aiomqtt
import pytest

from pons.mqtt.gateway import StopFirstQueue
from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from tests.pons.mqtt.broker import PASSWORD, USER, Broker
from tests.pons.mqtt.slow_line import SlowLine
from tests.pons.standing_bridge import StandingBridge

LIMIT_S = 30.0
ROBOT = "r1"


@dataclass
class Ears:
    """Keep the newest message of each topic, and all events."""

    client: aiomqtt.Client
    newest: dict[str, bytes] = field(default_factory=dict)
    events: list[dict[str, str]] = field(default_factory=list)
    names: list[str] = field(default_factory=list)

    async def hear(self) -> None:
        async for message in self.client.messages:
            topic = str(message.topic)
            self.names.append(topic)
            self.newest[topic] = bytes(message.payload)
            if topic.endswith("/event"):
                self.events.append(json.loads(message.payload))

    async def until(self, topic: str, payload: bytes) -> None:
        await until(lambda: self.newest.get(topic) == payload, f"{topic} {payload!r}: {self}")

    async def until_told(self, code: str) -> None:
        def is_told() -> bool:
            return any(event.get("code") == code for event in self.events)

        await until(is_told, lambda: f"{code}: {self.events}")


async def until(holds: Callable[[], bool], what: str | Callable[[], str]) -> None:
    for _ in range(round(LIMIT_S / 0.02)):
        if holds():
            return
        await asyncio.sleep(0.02)
    raise AssertionError(what if isinstance(what, str) else what())


@dataclass
class Joined:
    """Hold what a story needs: the broker, the bridge and the gateway's process."""

    broker: Broker
    bridge: StandingBridge
    process: subprocess.Popen[bytes]
    log: Path

    @asynccontextmanager
    async def ears(self) -> AsyncIterator[Ears]:
        """Listen to all that is said, as the home does."""
        trusted = ssl.create_default_context(cafile=str(self.broker.ca_file))
        async with aiomqtt.Client(
            "127.0.0.1", self.broker.port, username=USER, password=PASSWORD,
            protocol=aiomqtt.ProtocolVersion.V5, tls_context=trusted,
        ) as client:  # fmt: skip
            ears = Ears(client)
            await client.subscribe("#", qos=1)
            hearing = asyncio.create_task(ears.hear())
            try:
                yield ears
            finally:
                hearing.cancel()

    def told(self, story: Callable[[Ears], Awaitable[None]]) -> None:
        async def run() -> None:
            async with self.ears() as ears:
                await ears.until(f"pons/{ROBOT}/availability", b"online")
                await story(ears)

        try:
            asyncio.run(run())
        except AssertionError as failed:
            failed.add_note(self.log.read_text("utf-8")[-4000:])
            raise

    def stops(self) -> int:
        return self.bridge.asked.count("cmd/stop")


@contextmanager
def joined_home(broker: Broker, log: Path, port: int | None = None) -> Iterator[Joined]:
    """Start a gateway beside a bridge, in a home of their own."""
    with TemporaryDirectory(prefix="pons-mqtt-") as name:
        home = Path(name)
        (home / "settings.toml").write_text(broker.table(home, port))
        words = ["--home", name, "--robot", str(CHECKOUT / "robot.toml"), "--site", name]
        words += ["--host", "127.0.0.1", "--port", str(free_port())]
        with StandingBridge(home, ROBOT) as bridge, log.open("wb") as written:
            process = subprocess.Popen(
                [sys.executable, "-m", "pons.mqtt", *words],
                stdout=written, stderr=written, cwd=CHECKOUT,
            )  # fmt: skip
            try:
                yield Joined(broker, bridge, process, log)
            finally:
                process.terminate()
                process.wait(timeout=10)


@pytest.fixture(scope="module")
def joined(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Joined]:
    folder = tmp_path_factory.mktemp("broker")
    with Broker(folder) as broker, joined_home(broker, folder / "gateway.log") as made:
        yield made


def test_the_robot_is_described_and_says_that_its_planner_is_away(joined: Joined) -> None:
    async def story(ears: Ears) -> None:
        await ears.until(f"pons/{ROBOT}/planner", b"offline")
        config = json.loads(ears.newest[f"homeassistant/device/pons_{ROBOT}/config"])
        assert config["device"]["identifiers"] == [f"pons_{ROBOT}"]
        assert f"pons/{ROBOT}/state" not in ears.newest  # nothing is known of the robot

    joined.told(story)


@pytest.mark.nightly(keep=2)
@pytest.mark.parametrize(
    ("word", "payload"),
    [("stop", b"PRESS"), ("stop", b"\xff\x00"), ("command", b"stop"), ("sentence", "停".encode())],
)
def test_a_stop_reaches_the_bridge_without_a_planner(
    joined: Joined, word: str, payload: bytes
) -> None:
    before = joined.stops()

    async def story(ears: Ears) -> None:
        await ears.client.publish(f"pons/{ROBOT}/{word}", payload, qos=1)
        await until(lambda: joined.stops() > before, joined.log.read_text())

    joined.told(story)
    assert "mqtt" in joined.bridge.sources


def test_a_stop_behind_500_garbled_and_retained_messages_is_the_only_thing_asked(
    joined: Joined,
) -> None:
    before = list(joined.bridge.asked)

    async def story(ears: Ears) -> None:
        for number in range(500):
            word = ("command", "sentence", "segments")[number % 3]
            payload = (b"\xff\xfe" * 40, b"start", b'["kitchen"]', b"go home", b'{"v_mps": 1}')
            retained = number % 5 in (1, 2, 3)  # what would be an order comes retained
            await ears.client.publish(
                f"pons/{ROBOT}/{word}", payload[number % 5], qos=0, retain=retained
            )
        await ears.client.publish(f"pons/{ROBOT}/stop", b"PRESS", qos=1)
        await until(lambda: len(joined.bridge.asked) > len(before), joined.log.read_text())
        for word in ("command", "sentence", "segments"):
            await ears.client.publish(f"pons/{ROBOT}/{word}", b"", retain=True)

    joined.told(story)
    assert joined.bridge.asked[len(before) :] == ["cmd/stop"]
    assert len(joined.log.read_text().splitlines()) < 100


def test_a_refusal_is_told_with_its_code(joined: Joined) -> None:
    async def story(ears: Ears) -> None:
        await asyncio.sleep(1.1)  # refusals are told once a second
        await ears.client.publish(f"pons/{ROBOT}/command", b"clean_spot", qos=1)
        await ears.until_told("mqtt_unknown_command")
        await asyncio.sleep(1.1)
        await ears.client.publish(f"pons/{ROBOT}/sentence", b"go home", qos=1)
        await ears.until_told("planner_down")

    joined.told(story)


def test_a_home_that_starts_later_is_told_again(joined: Joined) -> None:
    topic = f"homeassistant/device/pons_{ROBOT}/config"

    async def story(ears: Ears) -> None:
        await until(lambda: ears.names.count(topic) == 1, "the kept description")
        await ears.client.publish("homeassistant/status", b"online", qos=1)
        await until(lambda: ears.names.count(topic) == 2, "the description once more")

    joined.told(story)


def test_a_broker_that_comes_back_is_joined_again_and_no_stop_was_lost(joined: Joined) -> None:
    joined.told(lambda ears: ears.until(f"pons/{ROBOT}/availability", b"online"))
    joined.broker.end()
    joined.broker.start()

    async def story(ears: Ears) -> None:
        before = joined.stops()
        await ears.client.publish(f"pons/{ROBOT}/stop", b"PRESS", qos=1)
        await until(lambda: joined.stops() > before, joined.log.read_text())

    joined.told(story)
    assert "mqtt_down" in joined.log.read_text()


def test_a_gateway_that_dies_is_told_by_its_will(tmp_path: Path) -> None:
    async def story(ears: Ears) -> None:
        made.process.kill()
        await ears.until(f"pons/{ROBOT}/availability", b"offline")

    with Broker(tmp_path) as broker, joined_home(broker, tmp_path / "gateway.log") as made:
        made.told(story)


def test_a_stop_goes_before_what_waits_and_finds_room_where_a_flood_leaves_none() -> None:
    def message(word: str, payload: bytes) -> aiomqtt.Message:
        return aiomqtt.Message(f"pons/{ROBOT}/{word}", payload, 1, False, 1, None)

    for stop in (("stop", b"PRESS"), ("command", b"stop"), ("sentence", "停".encode())):
        line = StopFirstQueue(maxsize=3)
        for number in range(3):
            line.put_nowait(message("sentence", f"go to room {number}".encode()))
        with pytest.raises(asyncio.QueueFull):
            line.put_nowait(message("sentence", b"go home"))
        line.put_nowait(message(*stop))
        taken = [line.get_nowait().payload for _ in range(line.qsize())]
        assert taken == [stop[1], b"go to room 0", b"go to room 1"]


@pytest.mark.nightly
def test_a_broker_that_is_slow_replays_an_hour_of_orders_or_answers_nothing(
    tmp_path: Path,
) -> None:
    async def stop_and_replay(ears: Ears) -> None:
        await ears.client.publish(f"pons/{ROBOT}/stop", b"PRESS", qos=1)
        await until(lambda: made.stops() > 0, made.log.read_text())
        line.late_s, line.is_shut = 0.0, True
        await ears.client.publish(f"pons/{ROBOT}/sentence", b"", qos=1)  # told by a code of its own
        for number in range(360):
            payload = f"go to room {number}".encode()
            await ears.client.publish(f"pons/{ROBOT}/sentence", payload, qos=1)
        line.is_shut = False  # all that the broker kept back comes at once
        await ears.until_told("mqtt_burst")
        await asyncio.sleep(1.0)  # longer than an order waits for others
        told = [event.get("code") for event in ears.events]
        assert "planner_down" not in told, "an order of the burst was given"

    with Broker(tmp_path) as broker, SlowLine(broker.port) as line:
        line.late_s = 1.0
        with joined_home(broker, tmp_path / "gateway.log", line.port) as made:
            made.told(stop_and_replay)
            assert made.bridge.asked == ["cmd/stop"]
            line.is_shut = True  # it takes everything, and acknowledges nothing
            told = partial(made.log.read_text, "utf-8")
            asyncio.run(until(lambda: "mqtt_down" in told(), "what became of the broker"))
            made.process.terminate()
            assert made.process.wait(timeout=10) == 0
