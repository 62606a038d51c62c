"""List the decoders that are fuzzed: good inputs, the reader itself, and how it may refuse.

A reader takes bytes and returns; any exception but its own refusals is a crash.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tools.attack import drive_lines, seeds
from tools.attack.unsound import Unsound

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


@dataclass(frozen=True, slots=True)
class Reader:
    """Hold a reader and the exceptions by which it may refuse."""

    read: Callable[[bytes], object]
    refusals: tuple[type[Exception], ...] = ()

    def takes(self, data: bytes) -> bool:
        """Return whether these bytes were taken; whatever else is raised is a crash."""
        try:
            self.read(data)
        except self.refusals as refusal:
            if not stable(refusal):
                raise Unsound(f"{type(refusal).__name__} without a code") from refusal
            return False
        return True


@dataclass(frozen=True, slots=True)
class AttackedDecoder:
    """Describe one decoder."""

    name: str
    seeds: Callable[[], Sequence[bytes]]
    prepare: Callable[[Path], Reader]
    """Loads it; the folder is empty and its own, for a reader that wants a file."""
    most_bytes: int = 4_096
    """Of an input here: small ones are many. Files of every size: ``tools.attack.files``."""


def stable(refusal: Exception) -> bool:
    """Return whether a refusal carries what a program may rely on: a code, or a model's why."""
    code = getattr(refusal, "code", None) or getattr(refusal, "why", None)
    return isinstance(code, str) and bool(code)


def _codec(_folder: Path) -> Reader:
    """Read a message of any key; what is taken must be in its size and say the same again."""
    from wire import DecodeFailure, decode, encode
    from wire.codec import image
    from wire.keys import CAMERA_COLOR, KEYS

    def read(data: bytes) -> object:
        key = KEYS[data[0] % len(KEYS)] if data else KEYS[0]
        payload = data[1:]
        image(CAMERA_COLOR, payload, payload[:100])
        message = decode(key, payload)
        if isinstance(message, DecodeFailure):
            return None
        again = encode(message)
        if type(message) is not key.message or decode(key, again) != message:
            raise Unsound(f"{key.path}: {again[:200]!r}")
        return message

    return Reader(read)


def _wav(_folder: Path) -> Reader:
    from planner.voice.wav import MAX_SECONDS, BadSound, read_wav

    def read(data: bytes) -> object:
        sound = read_wav(data)
        if not 0.0 < sound.seconds <= MAX_SECONDS:
            raise Unsound(f"{sound.seconds} s")
        return sound

    return Reader(read, (BadSound,))


def _mcap(folder: Path) -> Reader:
    from bridge.recording.mcap_reader import BadRecording
    from bridge.recording.recording_reader import read_recording

    path = folder / "input"

    def read(data: bytes) -> object:
        path.write_bytes(data)
        return sum(1 for _ in read_recording(path))

    return Reader(read, (BadRecording,))


def _model(_folder: Path) -> Reader:
    """Read a body, a plan, a look and a point, or a stream, by the first byte."""
    from planner.brain.endpoint.assembly import Assembly, StreamFailure
    from planner.brain.endpoint.completion import read_json, read_reply
    from planner.brain.endpoint.image_client import judge_look, judge_point
    from planner.brain.endpoint.plan_draft import Drafting
    from planner.brain.endpoint.plan_reply import judge
    from planner.brain.endpoint.response import Events
    from planner.brain.errors import BrainDown
    from planner.plan import RUNNABLE

    vocabulary = _vocabulary()
    drafting = Drafting(vocabulary, RUNNABLE, lambda _: None)

    def body(data: bytes) -> object:
        return judge(read_reply(read_json(data)).text, vocabulary)

    def plan(data: bytes) -> object:
        text = data.decode("utf-8", "replace")
        drafting.draft_of(text)
        return judge(text, vocabulary)

    def look(data: bytes) -> object:
        text = data.decode("utf-8", "replace")
        return judge_look(text), judge_point(text)

    def stream(data: bytes) -> object:
        events, assembly = Events(), Assembly()
        half = len(data) // 2
        try:
            for event in (*events.feed(data[:half]), *events.feed(data[half:]), *events.end()):
                assembly.add(event)
        except StreamFailure:
            return None
        drafting.draft_of(assembly.text)
        return judge(read_reply(assembly.completion()).text, vocabulary)

    ways = (body, plan, look, stream)

    def read(data: bytes) -> object:
        return ways[data[0] % len(ways)](data[1:]) if data else None

    return Reader(read, (BrainDown,))


def _image(folder: Path) -> Reader:
    import cv2  # beforehand, so that it does not count as memory that an input took

    from maps.image import read_image
    from planner.site import SiteError

    cv2.setNumThreads(1)
    path = folder / "input"

    def read(data: bytes) -> object:
        path.write_bytes(data)
        return read_image(path)

    return Reader(read, (SiteError,))


def _fence(folder: Path) -> Reader:
    from bridge.fence_file import parse_fence
    from planner.site import SiteError
    from planner.site.fence import load_fence
    from wire import ConfigError

    path = folder / "input"

    def read(data: bytes) -> object:
        path.write_bytes(data)
        ours = theirs = None
        try:
            ours = parse_fence(data)
        except ConfigError as refusal:
            theirs = refusal
        load_fence(path)
        return ours or theirs

    return Reader(read, (SiteError,))


def _toml(folder: Path) -> Reader:
    """Read bytes as robot.toml and as settings.toml; both refuse by the same class."""
    from planner.settings import FILE, load_settings
    from wire import ConfigError, load_robot

    path = folder / FILE

    def read(data: bytes) -> object:
        path.write_bytes(data)
        robot = None
        try:
            robot = load_robot(path)
        except ConfigError as refusal:
            if not refusal.code:
                raise Unsound("a refusal without a code") from None
        load_settings(folder, {})
        return robot

    return Reader(read, (ConfigError,))


def _yaml(folder: Path) -> Reader:
    """Read bytes as places.yaml and as map.yaml."""
    from maps.map_file import MapRecord
    from maps.yaml_records import parse_yaml
    from planner.site import SiteError
    from planner.site.places import load_places

    path = folder / "input"

    def read(data: bytes) -> object:
        path.write_bytes(data)
        try:
            return load_places(path)
        except SiteError:
            return parse_yaml(data, MapRecord, path)

    return Reader(read, (SiteError,))


def _ros2(_folder: Path) -> Reader:
    """Hear a robot's words on a base that is driven; what comes of them the wire must carry."""
    from ros2.ros_base import RosBase
    from wire import decode, encode, keys, load_robot

    robot = load_robot(seeds.SITES.parent / "robots" / "ros2_diff_drive.toml")
    state = seeds.ros2_words()[0].partition(b" ")[2]

    def read(data: bytes) -> object:
        name, _, payload = data.partition(b" ")
        base = RosBase(robot, "attacked")
        base.open(1.0)
        base.hear("state", state, 1.0)
        known = name.decode("ascii", "replace")
        heard = base.hear(known if known in base.names else "odom", payload, 1.01)
        base.judge(1.02)
        for made, again in (
            (heard.state, partial(decode, keys.DRIVE_STATE)),
            (heard.scan, partial(decode, keys.SCAN)),
            (heard.imu, partial(decode, keys.IMU)),
        ):
            if made is not None and again(encode(made)) != made:
                raise Unsound("a message that the wire does not carry")
        return base.status(1, 1.02)

    return Reader(read)


def _packed_picture(_folder: Path) -> Reader:
    """Read a picture's head and unpack its bytes, as the camera of a ROS 2 robot is read."""
    import cv2

    from ros2.pictures import RosPictureListener
    from sensors.camera.ros2_source import color_of, depth_of
    from sensors.camera.shot import CameraTrouble

    cv2.setNumThreads(1)

    def read(data: bytes) -> object:
        head, _, picture = data.partition(b"\n")
        heard = RosPictureListener("tcp/robot:1").hear(head, picture, 1.0)
        if heard is None:
            return None
        reader = depth_of if "epth" in heard.head.format else color_of
        return reader(heard.head, heard.data)

    return Reader(read, (CameraTrouble,))


def _language(_folder: Path) -> Reader:
    from planner.language import folding
    from planner.language.sentence import language_of
    from planner.language.stop import is_stop, read_stop

    def read(data: bytes) -> object:
        text = data.decode("utf-8", "surrogateescape")
        folding.fold_words(text)
        folding.count_chinese(text)
        language_of(text)
        if is_stop(text) and read_stop(text).value != "order":
            raise Unsound("the two readings of a stop differ")
        return read_stop(text)

    return Reader(read)


def _offline(_folder: Path) -> Reader:
    """Plan a sentence; what comes out must be a plan of the closed world."""
    from datetime import UTC, datetime

    from planner.language.grammar import Context, plan
    from planner.plan import PLAN, check_plan

    vocabulary = _vocabulary()
    context = Context(room="kitchen", now=datetime(2026, 1, 1, 12, tzinfo=UTC))

    def read(data: bytes) -> object:
        made = plan(data.decode("utf-8", "replace"), vocabulary, context)
        rejection = check_plan(PLAN.validate_python(made), vocabulary)
        if rejection is not None and rejection.repairable:
            raise Unsound(f"a plan that does not hold: {rejection}")
        return made

    return Reader(read)


def _drive(kind: str, _folder: Path) -> Reader:
    """Hear spoilt lines of a base in the middle of a drive."""
    return Reader(drive_lines.SpoiltLines(kind).read)


@cache
def _vocabulary() -> Any:
    from planner.site import Site
    from planner.site.site_view import vocabulary_of

    return vocabulary_of(Site.load(seeds.SITES / "home"))


DECODERS = (
    AttackedDecoder("codec", seeds.messages, _codec),
    AttackedDecoder("wav", seeds.recordings_of_speech, _wav),
    AttackedDecoder("mcap", seeds.small_recordings, _mcap, 8_192),
    AttackedDecoder("model", seeds.replies, _model),
    AttackedDecoder("image", seeds.pictures, _image),
    AttackedDecoder("fence", seeds.fences, _fence),
    AttackedDecoder("toml", lambda: [*seeds.robots(), *seeds.SETTINGS], _toml),
    AttackedDecoder("yaml", lambda: [*seeds.places(), *seeds.maps()], _yaml),
    AttackedDecoder("ros2", seeds.ros2_words, _ros2),
    AttackedDecoder("packed_picture", seeds.packed_pictures, _packed_picture),
    AttackedDecoder("language", seeds.texts, _language, 600),
    AttackedDecoder("offline", seeds.texts, _offline, 300),
    *(
        AttackedDecoder(kind, partial(drive_lines.lines_of, kind), partial(_drive, kind), 600)
        for kind in drive_lines.KINDS
    ),
)
BY_NAME = {decoder.name: decoder for decoder in DECODERS}
