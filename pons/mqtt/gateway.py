"""Join a robot to a smart home's broker: tell its state, take orders, stop at once.

A client of the planner's API and of the bridge's stop, in a process of its own. A broker that is
down is dialled again for ever; one that is slow gets the newest state and misses the older ones.
What the robot does, it does without a broker.
"""

from __future__ import annotations

import asyncio
import json
import logging
import ssl
import time
from typing import TYPE_CHECKING

import aiomqtt
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties
from paho.mqtt.subscribeoptions import SubscribeOptions

from pons import private_file
from pons.http import PlannerDown, PlannerProblem, fetch
from pons.mqtt import home_state, planner_orders
from pons.mqtt.direct_halt import DirectHalt
from pons.mqtt.discovery import OFFLINE, ONLINE, discovery, topics_of
from pons.mqtt.orders import TOPICS, HomeOrder, MessageRefusal, OrderGate, read_order
from pons.mqtt.planner_watch import PlannerView, PlannerWatch
from pons_assets.version import version_number
from processes.backoff import Backoff
from wire import ConfigError

if TYPE_CHECKING:
    from collections import deque
    from pathlib import Path

    from planner.settings import MqttSettings
    from pons.settings import LaunchSettings

log = logging.getLogger("home")

KEEPALIVE_S = 15
FIRST_PAUSE_S, LONGEST_PAUSE_S, STEADY_S = 1.0, 30.0, 30.0
ANSWER_S = 10.0
"""A broker that takes longer for one message is left and dialled again."""
TELL_S = 0.2
"""Between two looks at what has changed."""
GATE_S = 0.05
EVENT_EXPIRY_S = 60
"""An event that nobody could be told for so long is not told any more."""
REFUSED_S = 1.0
"""Between two refusals that are told; those between are counted."""
MOST_WAITING = 200
"""Messages that wait to be read; a flood's further ones are dropped unread, but for a stop."""
MAX_PACKET_BYTES = 65_536


class StopFirstQueue(asyncio.Queue[aiomqtt.Message]):
    """Hand on a stop before all that waits; in a line that a flood fills, make room for it."""

    def put_nowait(self, item: aiomqtt.Message) -> None:
        """Take a message; where the line is full, any but a stop is refused with QueueFull."""
        waiting: deque[aiomqtt.Message] = self._queue  # type: ignore[attr-defined]  # its own lack
        if not _is_stop(item):
            super().put_nowait(item)
            return
        if self.full():
            waiting.pop()
        super().put_nowait(item)
        waiting.rotate(1)


def _is_stop(message: aiomqtt.Message) -> bool:
    word = str(message.topic).rpartition("/")[2]
    order = read_order(word, message.payload, retained=False, rooms=())
    return isinstance(order, HomeOrder) and order.kind == "stop"


class HomeGateway:
    """Be the robot's side of one broker."""

    def __init__(
        self, launch: LaunchSettings, settings: MqttSettings, robot_id: str, *, has_camera: bool
    ) -> None:
        self._launch, self._settings = launch, settings
        self._topics = topics_of(settings, robot_id)
        self._config = json.dumps(
            discovery(settings, robot_id, version_number(), has_camera=has_camera)
        )
        self._pictures = has_camera and settings.picture_s > 0
        self._language = settings.language.value
        self._changed = asyncio.Event()
        self._view = PlannerView()
        self._gate = OrderGate()
        self._halt = DirectHalt(launch)
        self._stops = 0
        self._sent: dict[str, bytes] = {}
        self._refused: dict[str, tuple[float, int]] = {}
        """Of each code: when it was told last, and how many have come since."""
        self._refusals: list[home_state.Json] = []

    async def run(self) -> None:
        """Serve until cancelled."""
        watch = PlannerWatch(self._launch, self._view, self._changed.set)
        try:
            async with asyncio.TaskGroup() as tasks:
                tasks.create_task(watch.run())
                tasks.create_task(self._obey_when_due())
                tasks.create_task(self._join_for_ever())
        finally:
            self._halt.close()

    async def _join_for_ever(self) -> None:
        backoff, told = Backoff(FIRST_PAUSE_S, LONGEST_PAUSE_S, STEADY_S), ""
        while True:
            began_s = time.monotonic()
            try:
                await self._join()
            except* (aiomqtt.MqttError, OSError) as several:
                trouble = _describe(self._settings, several.exceptions[0])
                if trouble != told:
                    told = trouble
                    log.warning("%s", trouble)
            await asyncio.sleep(backoff.pause_after(time.monotonic() - began_s))

    async def _join(self) -> None:
        """Be connected once.

        Raises:
            ExceptionGroup: of MqttError or OSError: the broker is gone.
        """
        async with asyncio.TaskGroup() as tasks:
            client = _client(self._launch, self._settings, self._topics.of("availability"))
            async with client:
                log.info("joined %s:%d", self._settings.host, self._settings.port_to_dial)
                self._sent.clear()
                fresh = SubscribeOptions.RETAIN_DO_NOT_SEND
                once = SubscribeOptions(qos=1, retainAsPublished=True, retainHandling=fresh)
                for word in TOPICS:
                    await client.subscribe(self._topics.of(word), options=once)
                await client.subscribe(self._topics.birth, options=once)
                beside = [tasks.create_task(self._tell(client))]
                if self._pictures:
                    beside.append(tasks.create_task(self._show(client)))
                try:
                    async for message in client.messages:
                        self._hear(message)
                finally:
                    for task in beside:
                        task.cancel()
                    await _say_offline(client, self._topics.of("availability"))

    # Orders -------------------------------------------------------------------------------------

    def _hear(self, message: aiomqtt.Message) -> None:
        topic = str(message.topic)
        if topic == self._topics.birth:
            self._sent.clear()  # Home Assistant has started: all is told again
            self._changed.set()
            return
        rooms = home_state.segments(self._view.places, self._language)
        word = topic.rpartition("/")[2]
        order = read_order(word, message.payload, retained=bool(message.retain), rooms=rooms)
        if isinstance(order, MessageRefusal):
            self._refuse(order.code, order.detail)
        elif order.kind == "stop":
            self._stops += 1
            self._halt.stop()
            self._gate.forget()
        elif not self._gate.offer(order, time.monotonic()):
            self._refuse("mqtt_burst", f"{self._gate.dropped} orders that came at once are dropped")

    async def _obey_when_due(self) -> None:
        """Give orders one after the other; a stop meanwhile is said again behind each."""
        while True:
            await asyncio.sleep(GATE_S)
            for order in self._gate.due(time.monotonic()):
                stops = self._stops
                await self._give(order)
                if stops != self._stops:  # the planner may have taken the order after the stop
                    self._halt.stop()
                    break

    async def _give(self, order: HomeOrder) -> None:
        try:
            await asyncio.to_thread(
                planner_orders.give, self._launch, order, self._view.places, self._language
            )
        except PlannerProblem as refused:
            self._refuse(refused.code, refused.told.get(self._language) or refused.detail)
        except PlannerDown as trouble:
            self._refuse("planner_down", str(trouble))

    def _refuse(self, code: str, detail: str) -> None:
        """Log a refusal and tell the home, each code at most once a second."""
        now_s = time.monotonic()
        told_s, unsaid = self._refused.get(code, (float("-inf"), 0))
        if now_s - told_s < REFUSED_S:
            self._refused[code] = told_s, unsaid + 1
            return
        more = f" (and {unsaid} before)" if unsaid else ""
        self._refused[code] = now_s, 0
        log.warning("%s: %s%s", code, detail, more)
        self._refusals.append(
            {"event_type": "refused", "code": code, "message": f"{code}: {detail}"}
        )
        del self._refusals[:-10]
        self._changed.set()

    # State --------------------------------------------------------------------------------------

    async def _tell(self, client: aiomqtt.Client) -> None:
        while True:
            for topic, payload in self._states().items():
                if self._sent.get(topic) != payload:
                    await client.publish(topic, payload, qos=1, retain=True)
                    self._sent[topic] = payload
            while self._refusals:
                refusal = self._refusals[0]
                await self._tell_event(client, refusal)
                if refusal in self._refusals:  # else newer ones took its place meanwhile
                    self._refusals.remove(refusal)
            while self._view.news:
                since_s, goal = self._view.news[0]
                news = home_state.event(goal, self._language)
                if news is not None and time.monotonic() - since_s <= EVENT_EXPIRY_S:
                    await self._tell_event(client, news)
                self._view.news.popleft()
            await asyncio.sleep(TELL_S)
            await self._changed.wait()
            self._changed.clear()

    async def _tell_event(self, client: aiomqtt.Client, news: home_state.Json) -> None:
        await client.publish(
            self._topics.of("event"), _json(news), qos=1, properties=_expiry(EVENT_EXPIRY_S)
        )

    def _states(self) -> dict[str, bytes]:
        """Return all that is kept at the broker, by topic, in the order in which it is told."""
        topics, view = self._topics, self._view
        goals, language = view.goals, self._language
        found = {
            topics.config: self._config.encode(),
            topics.of("availability"): ONLINE.encode(),
            topics.of("planner"): (ONLINE if view.is_there else OFFLINE).encode(),
        }
        if not view.is_there:
            return found
        state = {
            "state": home_state.vacuum_state(view.robot, goals, view.home_place),
            "segments": home_state.segments(view.places, language),
        }
        found[topics.of("state")] = _json(state)
        found[topics.of("sensors")] = _json(
            home_state.sensors(view.robot, goals, view.places, language)
        )
        if (ended := home_state.newest_end(goals)) is not None:
            found[topics.of("answer")] = _json(home_state.event(ended, language))
        return found

    async def _show(self, client: aiomqtt.Client) -> None:
        expiry_s = round(3.0 * self._settings.picture_s) + 60
        while True:
            if self._view.is_there:
                try:
                    picture = await asyncio.to_thread(fetch, self._launch, "/v1/camera.jpg")
                    properties = _expiry(expiry_s)
                    await client.publish(
                        self._topics.of("camera"), picture, retain=True, properties=properties
                    )
                except (PlannerDown, PlannerProblem) as trouble:
                    log.debug("the picture: %s", trouble)
            await asyncio.sleep(self._settings.picture_s)


def _client(launch: LaunchSettings, settings: MqttSettings, availability: str) -> aiomqtt.Client:
    """Return a client that the broker keeps nothing for: what it missed is past."""
    connecting = Properties(PacketTypes.CONNECT)  # type: ignore[no-untyped-call]  # its own lack
    connecting.SessionExpiryInterval = 0
    connecting.MaximumPacketSize = MAX_PACKET_BYTES
    trusted = None
    if settings.tls:
        file = None if settings.ca_file is None else str(launch.home / settings.ca_file)
        trusted = ssl.create_default_context(cafile=file)
    quiet = logging.getLogger("mqtt.client")
    quiet.setLevel(logging.ERROR)  # a flood is told by us, and once
    return aiomqtt.Client(
        settings.host,
        settings.port_to_dial,
        username=settings.username,
        password=read_secret(launch, settings.password_file),
        protocol=aiomqtt.ProtocolVersion.V5,
        clean_start=True,
        properties=connecting,
        will=aiomqtt.Will(availability, OFFLINE, qos=1, retain=True),
        keepalive=KEEPALIVE_S,
        timeout=ANSWER_S,
        tls_context=trusted,
        queue_type=StopFirstQueue,
        max_queued_incoming_messages=MOST_WAITING,
        max_queued_outgoing_messages=MOST_WAITING,
        logger=quiet,
    )


def read_secret(launch: LaunchSettings, file: Path | None) -> str | None:
    """Return a password or token of a file of our own; None where none is named.

    Raises:
        ConfigError: as ``pons.private_file.read``, and ``mqtt_secret`` where it is not there.
    """
    if file is None:
        return None
    raw = private_file.read(launch.home / file)
    if raw is None:
        raise ConfigError("mqtt_secret", f"{launch.home / file} is not there")
    return raw.decode("utf-8", "replace").strip()


async def _say_offline(client: aiomqtt.Client, topic: str) -> None:
    """Say it where the broker still hears; else the will does."""
    try:
        await client.publish(topic, OFFLINE, qos=1, retain=True, timeout=1.0)
    except aiomqtt.MqttError:
        return


def _expiry(seconds: int) -> Properties:
    properties = Properties(PacketTypes.PUBLISH)  # type: ignore[no-untyped-call]  # its own lack
    properties.MessageExpiryInterval = seconds
    return properties


def _json(content: home_state.Json | None) -> bytes:
    return json.dumps(content, ensure_ascii=False).encode()


def _describe(settings: MqttSettings, error: BaseException) -> str:
    """Return a code, what came, and what to do."""
    place = f"{settings.host}:{settings.port_to_dial}"
    cause = error.__cause__ or error
    if isinstance(cause, ssl.SSLError):
        return f"mqtt_untrusted: {place}: {cause}; name the broker's authority in [mqtt] ca_file"
    if "ot authorized" in str(error) or "user name or password" in str(error):
        return f"mqtt_refused: {place}: {error}; look at [mqtt] username and password_file"
    return f"mqtt_down: {place}: {error}; is the broker running? It is dialled again"
