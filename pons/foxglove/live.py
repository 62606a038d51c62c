"""Show the running robot to Foxglove: a listener on the bus, a server on the loopback.

It hears what any judge of the bus hears, asks the planner for what only that knows (route, map,
objects), says nothing to either, and takes nothing from its viewers. While nobody watches a topic,
nothing is made for it; a viewer that does not read loses the oldest messages, and nobody waits.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from typing import TYPE_CHECKING, Any

import foxglove
from foxglove import channels
from foxglove import messages as fox
from foxglove.websocket import ServerListener

from pons.event_socket import follow_events
from pons.foxglove import scene
from pons.foxglove.topics import LiveTopic
from pons.http import call
from wire import Event, Mode, Status
from wire.codec import Image
from wire.keys import CAMERA_COLOR, EVENT, SCAN, STATUS, Party
from wire.sensors import Scan
from wire.session import open_session

if TYPE_CHECKING:
    from foxglove.websocket import ChannelView, Client

    from pons.settings import LaunchSettings
    from wire import RobotDescription
    from wire.image_transport import ImageSubscriber

log = logging.getLogger("foxglove")

PERIOD_S = 0.05
"""As often as the bridge says its status; a scan comes five times more rarely or so."""
MOST_WAITING = 64
"""Messages that wait for a viewer: three seconds of statuses, then the oldest go."""
STILL = (LiveTopic.MAP, LiveTopic.PLACES, LiveTopic.FENCE, LiveTopic.ROUTE, LiveTopic.OBJECTS)
"""Told when they change, and again to each that begins to watch."""
_WARNED = frozenset({Mode.FAULT, Mode.ESTOPPED, Mode.STOPPING})


class Watchers(ServerListener):
    """Count who watches which topic; the SDK calls from threads of its own."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._watching: dict[str, int] = {}
        self.begun: set[str] = set()
        """Topics that somebody began to watch, until they are told again."""

    def on_subscribe(self, client: Client, channel: ChannelView) -> None:
        """Count one more."""
        with self._lock:
            self._watching[channel.topic] = self._watching.get(channel.topic, 0) + 1
            self.begun.add(channel.topic)

    def on_unsubscribe(self, client: Client, channel: ChannelView) -> None:
        """Count one less."""
        with self._lock:
            self._watching[channel.topic] = max(0, self._watching.get(channel.topic, 0) - 1)

    def watches(self, *topics: LiveTopic) -> bool:
        """Tell whether somebody watches one of these."""
        return any(self._watching.get(topic) for topic in topics)

    def take_begun(self) -> set[str]:
        """Return the topics that somebody began to watch since the last call."""
        with self._lock:
            begun, self.begun = self.begun, set()
        return begun


class LiveView:
    """Be the server of one robot."""

    def __init__(self, settings: LaunchSettings, robot: RobotDescription) -> None:
        self._settings, self._robot = settings, robot
        self._context = foxglove.Context()
        self._watchers = Watchers()
        context = self._context
        self._typed: dict[LiveTopic, Any] = {
            LiveTopic.SCAN: channels.LaserScanChannel(LiveTopic.SCAN, context=context),
            LiveTopic.TRANSFORMS: channels.FrameTransformsChannel(
                LiveTopic.TRANSFORMS, context=context
            ),
            LiveTopic.POSE: channels.PoseInFrameChannel(LiveTopic.POSE, context=context),
            LiveTopic.ROUTE: channels.PosesInFrameChannel(LiveTopic.ROUTE, context=context),
            LiveTopic.MAP: channels.GridChannel(LiveTopic.MAP, context=context),
            LiveTopic.CAMERA: channels.CompressedImageChannel(LiveTopic.CAMERA, context=context),
            LiveTopic.BOXES: channels.ImageAnnotationsChannel(LiveTopic.BOXES, context=context),
            LiveTopic.LOG: channels.LogChannel(LiveTopic.LOG, context=context),
            **{
                topic: channels.SceneUpdateChannel(topic, context=context)
                for topic in (LiveTopic.PLACES, LiveTopic.FENCE, LiveTopic.OBJECTS)
            },
            **{
                topic: foxglove.Channel(topic, message_encoding="json", context=context)
                for topic in (LiveTopic.ROWS, LiveTopic.SPEEDS, LiveTopic.TICKS)
            },
        }
        self._still: dict[LiveTopic, Any] = {}
        self._things: dict[str, Any] = {}

    async def serve(self, port: int) -> None:
        """Serve on the loopback until cancelled."""
        server = foxglove.start_server(
            name=f"pons {self._robot.id}", host="127.0.0.1", port=port,
            server_listener=self._watchers, context=self._context,
            message_backlog_size=MOST_WAITING,
        )  # fmt: skip
        log.info("ws://127.0.0.1:%d (Foxglove: Open connection)", server.port)
        try:
            async with asyncio.TaskGroup() as tasks:
                tasks.create_task(self._hear_the_bus())
                tasks.create_task(
                    follow_events(
                        self._settings,
                        ("snapshot", "path", "sight", "places"),
                        self._take_frame,
                        lambda: None,
                    )
                )
        finally:
            server.stop()

    async def _hear_the_bus(self) -> None:
        with open_session(Party.JUDGE, self._robot.id, self._settings.home) as session:
            statuses, events = session.subscriber(STATUS), session.subscriber(EVENT)
            scans = session.subscriber(SCAN)
            pictures: ImageSubscriber | None = None
            while True:
                await asyncio.sleep(PERIOD_S)
                for topic in self._watchers.take_begun():
                    if (kept := self._still.get(LiveTopic(topic))) is not None:
                        self._typed[LiveTopic(topic)].log(kept)
                if (status := statuses.newest()) is not None:
                    self._show_status(status)
                if self._watchers.watches(LiveTopic.SCAN) and (found := scans.newest()) is not None:
                    self._show_scan(found)
                for event in events.drain().items:
                    if isinstance(event, Event):
                        self._show_event(event)
                if self._watchers.watches(LiveTopic.CAMERA) is (pictures is None):
                    if pictures is not None:  # the camera rests while nobody looks
                        pictures.close()
                        pictures = None
                    else:
                        pictures = session.image_subscriber(CAMERA_COLOR)
                if pictures is not None and isinstance(picture := pictures.newest(), Image):
                    self._show_picture(picture)

    def _show_status(self, status: Status) -> None:
        watches = self._watchers.watches
        if watches(LiveTopic.TRANSFORMS):
            self._typed[LiveTopic.TRANSFORMS].log(scene.transforms(status))
        if watches(LiveTopic.POSE) and (here := scene.pose(status)) is not None:
            self._typed[LiveTopic.POSE].log(here)
        for topic, make in (
            (LiveTopic.SPEEDS, scene.speeds),
            (LiveTopic.TICKS, scene.ticks),
            (LiveTopic.ROWS, scene.rows),
        ):
            if watches(topic):
                self._typed[topic].log(make(status))

    def _show_scan(self, found: Scan) -> None:
        self._typed[LiveTopic.SCAN].log(scene.scan(found, self._robot.lidar))

    def _show_event(self, event: Event) -> None:
        level = fox.LogLevel.Warning if event.mode in _WARNED else fox.LogLevel.Info
        text = f"{event.code} {event.detail}".rstrip()
        self._typed[LiveTopic.LOG].log(fox.Log(level=level, message=text, name="bridge"))

    def _show_picture(self, picture: Image) -> None:
        self._typed[LiveTopic.CAMERA].log(
            fox.CompressedImage(frame_id="camera", data=picture.data, format="jpeg")
        )

    # What the planner alone knows -----------------------------------------------------------------

    async def _take_frame(self, frame: dict[str, Any]) -> None:
        kind = frame["kind"]
        if kind in ("snapshot", "places"):
            await self._read_the_map()
        if kind in ("snapshot", "path"):
            self._keep(LiveTopic.ROUTE, scene.route(frame["path"]))
        if kind == "snapshot":
            told = await asyncio.to_thread(call, self._settings, "GET", "/v1/objects")
            self._things = {thing["id"]: thing for thing in told["objects"]}
        if kind in ("snapshot", "sight"):
            sight = frame["sight"]
            self._things |= {thing["id"]: thing for thing in sight["things"]}
            self._keep(LiveTopic.OBJECTS, scene.things(self._things.values()))
            if self._watchers.watches(LiveTopic.BOXES):
                self._typed[LiveTopic.BOXES].log(scene.boxes(sight["look"]))

    async def _read_the_map(self) -> None:
        told = await asyncio.to_thread(call, self._settings, "GET", "/v1/map")
        places = await asyncio.to_thread(call, self._settings, "GET", "/v1/places")
        self._keep(LiveTopic.MAP, scene.grid(told))
        self._keep(LiveTopic.FENCE, scene.fence(told["fence"]))
        self._keep(LiveTopic.PLACES, scene.places(places["places"]))

    def _keep(self, topic: LiveTopic, message: Any) -> None:
        self._still[topic] = message
        self._typed[topic].log(message)
