"""List the kinds of file that the product reads: good ones, bombs, and the real reader of each.

A bomb is a small file of a known kind that asks for much: time, memory, nesting.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pons.settings import CHECKOUT
from tools.attack import seeds

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    Loaded = tuple[Callable[[Path], object], tuple[type[Exception], ...]]


@dataclass(frozen=True, slots=True)
class FileKind:
    """Describe one kind of file."""

    name: str
    file: str
    """What it is called in the folder."""
    seeds: Callable[[], Sequence[bytes]]
    load: Callable[[], Loaded]
    """Imports the real reader; it takes the folder. Beside it, the refusals it may raise."""
    bombs: Callable[[], Sequence[bytes]] = lambda: ()
    bound_mb: float = 200.0
    """Most that reading one may add to memory: a small file, and no reason to take much."""
    beside: Callable[[Path], None] = lambda _: None
    """Writes what else must lie in the folder."""


def _model() -> Loaded:
    from planner.perception.detect.model_file import ModelOptions, open_model
    from planner.perception.failure import VisionFailure

    return lambda folder: open_model(ModelOptions(folder / "model.onnx")), (VisionFailure,)


def _wav() -> Loaded:
    from planner.voice.wav import BadSound, read_wav

    return lambda folder: read_wav((folder / "said.wav").read_bytes()), (BadSound,)


def _mcap() -> Loaded:
    from bridge.recording.recording_reader import BadRecording, read_recording

    return lambda folder: sum(1 for _ in read_recording(folder / "box.mcap")), (BadRecording,)


def _replay() -> Loaded:
    from bridge.recording.recording_reader import BadRecording
    from bridge.replay import replay
    from bridge.stop_report import last_stop

    def read(folder: Path) -> object:
        return last_stop(folder), replay([folder / "box.mcap"])

    return read, (BadRecording,)


def _map() -> Loaded:
    """Read a map as the planner does, and its name as every process does."""
    import cv2
    import numpy  # noqa: F401, ICN001  # loaded beforehand, so that no file pays for it

    from maps.map_file import load_map
    from planner.site import SiteError
    from wire import ConfigError
    from wire.site_map import read_map_id

    cv2.setNumThreads(1)

    def read(folder: Path) -> object:
        try:
            name = read_map_id(folder)
        except ConfigError:
            name = ""
        return load_map(folder / "map.yaml"), name

    return read, (SiteError,)


def _places() -> Loaded:
    from planner.site import SiteError
    from planner.site.places import load_places

    return lambda folder: load_places(folder / "places.yaml"), (SiteError,)


def _home() -> Loaded:
    from sim.site.load import load_home
    from wire import ConfigError

    return load_home, (ConfigError,)


def _fence() -> Loaded:
    """Read a fence as the bridge and as the planner do; both must refuse in their own words."""
    from bridge.fence_file import load_fence as of_bridge
    from planner.site import SiteError
    from planner.site.fence import load_fence as of_planner
    from wire import ConfigError

    def read(folder: Path) -> object:
        path = folder / "fence.json"
        try:
            ours = of_bridge(path)
        except ConfigError:
            ours = None
        return ours, of_planner(path)

    return read, (SiteError,)


def _robot() -> Loaded:
    from wire import ConfigError, load_robot

    return lambda folder: load_robot(folder / "robot.toml"), (ConfigError,)


def _settings() -> Loaded:
    from planner.settings import load_settings
    from wire import ConfigError

    return lambda folder: load_settings(folder, {}), (ConfigError,)


def _load_kept_files() -> Loaded:
    """Read the small JSON files of a home folder: brakes, and the stores of the layout before."""
    from bridge.braking_file import load_learnt
    from maps.yaml_records import parse_json, read_bytes
    from planner.perception.object_store import StoredThings
    from planner.site import SiteError
    from planner.site.fence_store import FenceProposal
    from planner.site.taught_places import TaughtFile
    from wire import load_robot

    robot = load_robot(CHECKOUT / "robot.toml")

    def read(folder: Path) -> object:
        path, found = folder / "kept.json", list[object]()
        found.append(load_learnt(path, robot))
        for model in (TaughtFile, StoredThings, FenceProposal):
            try:
                found.append(parse_json(read_bytes(path), model, path))
            except SiteError as refused:
                found.append(refused.code)
        return found

    return read, (SiteError,)


def _labels() -> Loaded:
    from planner.perception.detect.class_names import names_of
    from planner.perception.failure import VisionFailure

    return lambda folder: names_of(folder / "labels.txt"), (VisionFailure,)


def alias_bomb() -> bytes:
    """Return YAML of 300 bytes that means ten thousand million items."""
    levels = [b"a0: &a0 [x,x,x,x,x,x,x,x,x,x]"]
    levels += [
        b"a%d: &a%d [%s]" % (n, n, b",".join([b"*a%d" % (n - 1)] * 10)) for n in range(1, 10)
    ]
    return b"\n".join(levels)


def _yaml_bombs() -> list[bytes]:
    return [
        alias_bomb(),
        b"[" * 20_000,
        b"a: " * 5_000,
        b"? " * 5_000,
        b"- " * 20_000,
        b"a: " + b"9" * 5_000,
        b"a: 2001-99-99",
        *_tag_bombs(),
    ]


def _tag_bombs() -> list[bytes]:
    """Return YAML whose tags name makers of values that can't make these."""
    tags = ("int", "float", "bool", "null", "timestamp", "binary", "omap", "pairs", "set", "map")
    return [f"a: !!{tag} {value}".encode() for tag in tags for value in ("''", "x", "[a]", "9999")]


def _skill() -> Loaded:
    from planner.skill_files.problems import SkillProblem
    from planner.skill_files.skill_file import read_skill

    return lambda folder: read_skill(folder / "skill.toml"), (SkillProblem,)


def _toml_bombs() -> list[bytes]:
    tables = b"".join(b"[" + b"a." * n + b"b]\n" for n in range(1, 250))
    return [b"a = " + b"[" * 50_000, b"a = " + b"{b=" * 9_000, b"a = " + b"9" * 5_000, tables,
            b"a." * 20_000 + b"b = 1", b"a = 1979-05-27T99:00:00Z"]  # fmt: skip


def _json_bombs() -> list[bytes]:
    return [b"[" * 100_000, b'{"a":' * 50_000, b'{"version": ' + b"9" * 60_000 + b"}"]


def _fence_bombs() -> list[bytes]:
    """Return fences of many corners, whose sides are compared pair by pair."""
    zigzag = ",".join(f"[{n / 100},{n % 2}]" for n in range(1000))
    outline = f"[{zigzag},[10,5],[0,5]]"
    outlines = ",".join([f"[{zigzag[: zigzag.rfind('[', 0, -20) - 1]},[9,5],[0,5]]"] * 60)
    head = '{"version":1,"map_id":"0000000000000000","allowed":['
    return [f"{head}{outline}]}}".encode(), f"{head}{outlines}]}}".encode(), *_json_bombs()]


def _image_bombs() -> list[bytes]:
    """Return pictures that claim more than they hold."""
    head = b"\x89PNG\r\n\x1a\n" + _chunk(
        b"IHDR", struct.pack(">IIBBBBB", 8000, 8000, 8, 0, 0, 0, 0)
    )
    zeros = zlib.compress(bytes(8001) * 8000, 9)
    return [
        b"P5 8000 8000 255\n", b"P2 8000 8000 255\n" + b"0 " * 30_000,
        b"P5 " + b"9" * 5000 + b" 1 255\n", b"P2 2 1 255\n" + b"9" * 60_000 + b" 1",
        head + struct.pack(">I", 2**31 - 1) + b"tEXtxxxx",
        head + _chunk(b"IDAT", zeros) + _chunk(b"IEND", b""),
        head + _chunk(b"zTXt", b"a\x00\x00" + zlib.compress(bytes(40_000_000), 9))
        + _chunk(b"IEND", b""),
    ]  # fmt: skip


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def _mcap_bombs() -> list[bytes]:
    """Return boxes whose one chunk holds a gigabyte of zeros in a few kilobytes."""
    import zstandard

    piece, whole = bytes(1 << 20), 1 << 30
    bombs = []
    for claimed, framed in ((1000, whole), (1 << 27, whole), (1 << 27, -1), (whole, whole)):
        packer = zstandard.ZstdCompressor().compressobj(size=framed)
        packed = b"".join([*(packer.compress(piece) for _ in range(1024)), packer.flush()])
        body = struct.pack("<QQQI", 0, 0, claimed, 0) + struct.pack("<I", 4) + b"zstd"
        body += struct.pack("<Q", len(packed)) + packed
        bombs.append(b"\x89MCAP0\r\n" + struct.pack("<BQ", 6, len(body)) + body)
    return bombs


def _beside_image(folder: Path) -> None:
    (folder / "map.yaml").write_bytes(seeds.maps()[0])


def _beside_map(folder: Path) -> None:
    (folder / "map.pgm").write_bytes(seeds.pictures()[0])


_BOXES = ("box.mcap", lambda: [*seeds.recordings(), *seeds.small_recordings()])
KINDS = (
    FileKind("ONNX model", "model.onnx", lambda: [seeds.MODEL.read_bytes()], _model,
             bound_mb=1_000.0),
    FileKind("WAV", "said.wav", seeds.recordings_of_speech, _wav),
    FileKind("MCAP, read", *_BOXES, _mcap, _mcap_bombs, 400.0),
    FileKind("MCAP, replayed", *_BOXES, _replay, bound_mb=400.0),
    FileKind("map.yaml", "map.yaml", seeds.maps, _map, _yaml_bombs, beside=_beside_map),
    FileKind("map image", "map.pgm", seeds.pictures, _map, _image_bombs, 400.0, _beside_image),
    FileKind("places.yaml", "places.yaml", seeds.places, _places, _yaml_bombs),
    FileKind("home.yaml", "home.yaml", seeds.homes, _home, _yaml_bombs),
    FileKind("fence.json", "fence.json", seeds.fences, _fence, _fence_bombs),
    FileKind("robot.toml", "robot.toml", seeds.robots, _robot, _toml_bombs),
    FileKind("settings.toml", "settings.toml", lambda: seeds.SETTINGS, _settings, _toml_bombs),
    FileKind("skill", "skill.toml", lambda: seeds.SKILLS, _skill, _toml_bombs),
    FileKind("kept JSON", "kept.json", seeds.kept_seeds, _load_kept_files, _json_bombs),
    FileKind("labels", "labels.txt", lambda: [b'["cup", "chair"]', b"cup\nchair\n"], _labels,
             _json_bombs),
)  # fmt: skip
