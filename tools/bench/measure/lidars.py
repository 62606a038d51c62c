"""Measure the lidars: what reading costs, what spoilt frames do, what a bad line does to a drive.

Decoding: processor time of the shipped reader, scans encoded as on the wire, beside the time that
its bytes span. Spoilt frames: what a decoder believes is held against the format's check, reckoned
a second time here; "beyond" is what it believed though no place in the bytes passes. Drives: in
lockstep, with twin, line and reader; every second time a crate stands a metre ahead from the
fault's first moment on.
"""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from math import cos, sin
from random import Random
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np

from sensors.lidar.kinds import LidarDecoder, kind_of
from sensors.lidar.reader import LidarReader
from sim.twin.lidar import LidarFirmware
from sim.twin.lidar_formats import crc_4d
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.serial_line import LineFault, SerialLine
from tools.lockstep.world_fork import fork_world
from wire import Mode, RobotDescription, encode
from wire.lidar_config import LidarConfig

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from tools.bench.context import BenchLab

NAME = "lidars"
TITLE = "lidars: cost of reading, spoilt frames, faults of the line in mid-drive"
LONG_ONLY = True
LIDARS: dict[str, dict[str, object]] = {
    "ld19": {"kind": "ld19"},
    "rplidar a1": {"kind": "rplidar", "model": "a1", "scan_s": 0.18},
    "rplidar a2": {"kind": "rplidar", "model": "a2"},
    "rplidar s2": {"kind": "rplidar", "model": "s2"},
    "ydlidar x4": {"kind": "ydlidar", "model": "x4"},
    "ydlidar g2": {"kind": "ydlidar", "model": "g2"},
}
DRIVEN = ("ld19", "rplidar a1")
COST_S = 30.0
FRAMES = 1_000_000
SLICES = 10
SPAN = 8
"""Frames between good ones in one stream of the fuzz."""
FAULT_S = 2.0
AFTER_S = 60.0
AHEAD_M = 1.0
RIGHT_CODES = {
    LineFault.GARBAGE: {"lidar_spoilt", "lidar_unreadable"},
    LineFault.CUT: {"lidar_spoilt"},
    LineFault.FLIPPED: {"lidar_spoilt"},
    LineFault.SILENT: {"lidar_silent"},
    LineFault.HUNG_UP: {"port_gone"},
    LineFault.WRONG_BAUD: {"lidar_unreadable"},
}


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure all three."""
    rows = [_cost(name) for name in LIDARS]
    each = lab.count(FRAMES // 100, FRAMES) // SLICES
    for name in LIDARS:
        take = partial(_fuzz_slice, name, each)
        runs = [FuzzCount(**run) for run in lab.slices(f"fuzz {name}", SLICES, take)]
        rows += _fuzz_rows(name, runs)
    trials = lab.count(4, 50)
    for name in DRIVEN:
        for fault in LineFault:
            take = partial(_drive_slice, name, fault)
            found = [DriveTrial(**one) for one in lab.slices(f"drive {name} {fault}", trials, take)]
            rows.append(_drive_row(name, fault, found))
    return rows


def _fuzz_slice(name: str, each: int, index: int) -> dict[str, Any]:
    return asdict(fuzz(name, index, each))


def _drive_slice(name: str, fault: LineFault, index: int) -> dict[str, Any]:
    return asdict(drive(name, fault, index))


def config_of(name: str) -> LidarConfig:
    """Return one lidar's part of robot.toml."""
    return LidarConfig.model_validate({"port": "/dev/lidar", **LIDARS[name]})


def _room(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
    return tuple((2.0 + np.cos(directions_rad)).tolist())


# What reading costs -------------------------------------------------------------------------------


def _cost(name: str, seconds: float = COST_S) -> ReportRow:
    config = config_of(name)
    line, firmware = SerialLine(1), LidarFirmware(config)
    reader = LidarReader(kind_of(config), line, "/dev/lidar", "bench")
    shares: list[float] = []
    used_s, scans, now_s = 0.0, 0, 100.0
    for tick in range(1, round(seconds / TICK_S) + 1):
        now_s += TICK_S
        line.put(firmware.tick(line.take_heard(), now_s, _room))
        began_s = time.thread_time()
        for at_s in (now_s, now_s + TICK_S / 2):  # it looks every 5 ms
            for scan in reader.turn(at_s):
                encode(scan)
                scans += 1
        used_s += time.thread_time() - began_s
        if tick % 100 == 0:
            shares.append(100.0 * used_s)
            used_s = 0.0
    points = firmware.model.beams_per_s
    note = f"{median(shares[2:]) * 4_500 / points:.2f} at 4 500 points/s; its {points:.0f}, "
    note += f"{scans / seconds:.1f} scans/s of {reader.shape.beams} beams"
    return row_of(f"reading {name}", "% of a core", "<= 5 at 4 500", shares[2:], note)


# What spoilt frames do ----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class FuzzCount:
    """Count what became of spoilt frames."""

    frames: int
    crashes: int
    believed: int
    """Frames, or beams of the standard answer, that were read though they were spoilt."""
    beyond: int
    """Of those, the ones that the format's own check would have refused."""


def fuzz(name: str, seed: int, count: int) -> FuzzCount:
    """Spoil so many frames of one lidar, and hold what is believed against the format's check."""
    random = Random(f"{name} {seed}")
    frames, head = _good_frames(name)
    crashes = believed = beyond = done = 0
    while done < count:
        good = [random.choice(frames) for _ in range(SPAN)]
        spoilt = [_spoil(frame, random) for frame in good]
        done += sum(one != frame for one, frame in zip(spoilt, good, strict=True))
        stream = b"".join(spoilt)
        untouched = sum(one == frame for one, frame in zip(spoilt, good, strict=True))
        decoder = kind_of(config_of(name)).decoder()
        if head:
            decoder.feed(head, 1.0)
        try:
            for at in range(0, len(stream), 61):
                decoder.feed(stream[at : at + 61], 1.0 + 1e-4 * at)
        except Exception:  # noqa: BLE001  # any is what is counted
            crashes += 1
            continue
        found = decoder.frames
        believed += max(0, found - untouched)
        beyond += max(0, found - _passing(name, stream))
    return FuzzCount(done, crashes, believed, beyond)


@lru_cache(maxsize=len(LIDARS))
def _good_frames(name: str) -> tuple[tuple[bytes, ...], bytes]:
    """Return frames that follow each other, and what goes before them."""
    firmware = LidarFirmware(config_of(name))
    asked = {"rplidar": b"\xa5\x20", "ydlidar": b"\xa5\x60"}.get(firmware.family, b"")
    firmware.tick(asked, 1.0, _room)
    stream = b"".join(firmware.tick(b"", 1.0 + 0.01 * k, _room) for k in range(1, 60))
    size = _size(name)
    if size is None:
        pieces = stream.split(b"\xaa\x55")
        return tuple(b"\xaa\x55" + piece for piece in pieces[1:-1]), b""
    head = b""
    if firmware.family == "rplidar":
        kind = kind_of(config_of(name)).decoder()
        head = _head_of(kind, firmware)
    count = len(stream) // size
    return tuple(stream[k * size : (k + 1) * size] for k in range(1, count)), head


def _head_of(decoder: LidarDecoder, firmware: LidarFirmware) -> bytes:
    """Return the descriptor of the answer that a decoder asks for."""
    answers = {"rp81": "a55a0500004081", "rp82": "a55a5400004082", "rp85": "a55a5400004085"}
    return bytes.fromhex(answers[firmware.model.form]) if decoder.opening else b""


def _size(name: str) -> int | None:
    return {"ld19": 47, "rplidar a1": 5, "rplidar a2": 84, "rplidar s2": 84}.get(name)


def _spoil(frame: bytes, random: Random) -> bytes:
    """Return a frame with flipped bits, other bytes, bytes missing or bytes too many."""
    body = bytearray(frame)
    way = random.randrange(4)
    at = random.randrange(len(body))
    if way == 0:
        for _ in range(random.choice((1, 1, 2, 3, 5))):
            body[random.randrange(len(body))] ^= 1 << random.randrange(8)
    elif way == 1:
        end = min(len(body), at + random.randint(1, 20))
        body[at:end] = random.randbytes(end - at)
    elif way == 2:
        del body[at : at + random.randint(1, 20)]
    else:
        body[at:at] = random.randbytes(random.randint(1, 20))
    return bytes(body)


def _passing(name: str, stream: bytes) -> int:
    """Count the places in a stream at which a frame begins that its format's check lets pass."""
    if name == "ld19":
        heads = (k for k in range(len(stream) - 46) if stream[k : k + 2] == b"\x54\x2c")
        return sum(crc_4d(stream[k : k + 46]) == stream[k + 46] for k in heads)
    if name == "rplidar a1":
        return sum(
            (stream[k] & 3) in (1, 2) and stream[k + 1] & 1 == 1 for k in range(len(stream) - 4)
        )
    if name.startswith("rplidar"):
        return sum(
            _express_passes(stream[k : k + 84])
            for k in range(len(stream) - 83)
            if stream[k] >> 4 == 0xA and stream[k + 1] >> 4 == 5
        )
    size = 3 if name.endswith("g2") else 2
    return sum(
        _yd_passes(stream[k:], size)
        for k in range(len(stream) - 9)
        if stream[k : k + 2] == b"\xaa\x55"
    )


def _express_passes(frame: bytes) -> bool:
    column = np.bitwise_xor.reduce(np.frombuffer(frame[2:], np.uint8))
    return int(column) == (frame[1] & 0xF) << 4 | frame[0] & 0xF


def _yd_passes(data: bytes, size: int) -> bool:
    end = 10 + data[3] * size
    if not data[3] or len(data) < end:
        return False
    samples = np.frombuffer(data[10:end], np.uint8).reshape(-1, size).astype(int)
    words = samples[:, -2] | samples[:, -1] << 8
    check = int(np.bitwise_xor.reduce(words))
    if size == 3:
        check ^= int(np.bitwise_xor.reduce(samples[:, 0]))
    for at in (0, 2, 4, 6, 8):
        check ^= data[at] | data[at + 1] << 8
    return check == 0


def _fuzz_rows(name: str, runs: list[FuzzCount]) -> list[ReportRow]:
    frames = sum(run.frames for run in runs)
    crashes, beyond = (sum(getattr(run, what) for run in runs) for what in ("crashes", "beyond"))
    believed = sum(run.believed for run in runs)
    odds = f"read though spoilt: {believed} ({believed / max(1, frames):.3%}), as the check lets"
    return [
        ReportRow(
            f"spoilt frames {name}: crashes", "", "0", value=str(crashes), note=none_in(frames)
        ),
        ReportRow(f"spoilt frames {name}: beyond its check", "", "0", value=str(beyond), note=odds),
    ]


# What a bad line does to a drive ------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class DriveTrial:
    """Tell what became of one fault of the line."""

    codes: tuple[str, ...]
    stood_s: float | None
    """From the fault until the robot stood; None where it drove on."""
    contacts: int
    arrived: bool


def drive(name: str, fault: LineFault, seed: int) -> DriveTrial:
    """Spoil the line at a moment of a drive, watch for FAULT_S, mend it, and see it arrive."""
    world = fork_world(_cruising(name))
    random = Random(f"{name} {fault} {seed}")
    world.run(random.uniform(0.0, 6.0))
    crate = seed % 2 == 1
    if crate:
        at = world.truth
        world.sim.place_obstacle(
            at.x_m + AHEAD_M * cos(at.yaw_rad), at.y_m + AHEAD_M * sin(at.yaw_rad)
        )
    lidar = world.lidar
    if lidar is None:
        raise ValueError(f"{name} has no line in lockstep")
    lidar.line.break_down(fault)
    codes = dict[str, None]()
    stood_s = None
    for tick in range(1, round(FAULT_S / TICK_S) + 1):
        world.tick()
        verdict = lidar.reader.judge(world.now_s)
        if verdict is not None:
            codes[verdict.code] = None
        if stood_s is None and world.standing:
            stood_s = tick * TICK_S
    lidar.line.break_down(None)
    if crate:
        world.sim.remove_obstacle()
    waited_s = 0.0
    while not _has_arrived(world) and waited_s < AFTER_S:
        world.run(1.0)
        waited_s += 1.0
    return DriveTrial(tuple(codes), stood_s, world.contacts, waited_s < AFTER_S)


def _has_arrived(world: LockstepWorld) -> bool:
    return world.status.leg is not None and world.status.leg.reached


@lru_cache(maxsize=len(LIDARS))
def _cruising(name: str) -> LockstepWorld:
    """Drive off; each fault of this lidar spoils the same drive at another moment."""
    robot = RobotDescription(lidar=config_of(name))
    world = LockstepWorld(site="home", seed=1, robot=robot)
    world.say("go to the kitchen")
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE and w.twist.v_mps > 0.4, 30.0)
    return world


def _drive_row(name: str, fault: LineFault, trials: list[DriveTrial]) -> ReportRow:
    right = RIGHT_CODES[fault]
    told = sum(bool(right & set(one.codes)) for one in trials)
    contacts = sum(one.contacts for one in trials)
    arrived = sum(one.arrived for one in trials)
    drove_on = sum(one.stood_s is None for one in trials)
    last = Counter(one.codes[-1] if one.codes else "nothing" for one in trials)
    note = (
        f"contacts {contacts} of {len(trials)}; told rightly {told}; arrived after {arrived}; "
        f"drove on {drove_on}; last code {dict(last)}"
    )
    stood = [one.stood_s for one in trials if one.stood_s is not None]
    what = f"{name}, {fault}: stands after"
    return row_of(what, "s", "contacts 0, told >= 95 %", stood, note)
