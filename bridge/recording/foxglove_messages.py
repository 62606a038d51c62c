"""Convert the bridge's own JSON into Foxglove's well-known schemas.

Scan, frames, pose, plan and log, for viewers: replay and `pons why` read none of it but the scan's
ranges. Each function returns topic and bytes of what one of our messages is worth there. Numbers
are put into JSON by hand, which takes 8 % off what the whole process costs.
"""

from __future__ import annotations

import json
from math import cos, sin
from typing import TYPE_CHECKING, Any

from bridge.recording import protobuf
from bridge.recording.topics import LOG, PLAN, POSE, SCAN, TRANSFORMS

if TYPE_CHECKING:
    from collections.abc import Iterator

Made = tuple[str, bytes]
_NS = 1_000_000_000
_FAR_S = 5.0
"""A sensor's stamp further from now than this is of another clock."""
_INFO, _WARNING = 2, 3
_GRAVE = (b'"mode":"FAULT"', b'"mode":"ESTOPPED"', b'"mode":"STOPPING"', b'"code":"row_up"')


class UnixClock:
    """Turn the host's monotonic time into UNIX time by one offset for the whole run."""

    def __init__(self, offset_s: float) -> None:
        self._offset_ns = round(offset_s * _NS)

    def ns(self, at_s: float) -> int:
        """Return UNIX time [ns]; MCAP knows none before 1970."""
        return max(0, self._offset_ns + round(at_s * _NS))

    def stamped_ns(self, stamp_s: float, now_s: float) -> int:
        """Return when a sensor measured, as far as its clock is this host's."""
        return self.ns(stamp_s if abs(stamp_s - now_s) <= _FAR_S else now_s)


def from_boot(payload: bytes) -> tuple[float, float, float]:
    """Return where the lidar sits on the robot: x, y [m] and yaw [rad] in ``base``."""
    lidar = json.loads(payload)["config"]["robot"]["lidar"]
    return float(lidar["x_m"]), float(lidar["y_m"]), float(lidar["yaw_rad"])


def from_inbox(
    payload: bytes, ranges: bytes | None, lidar: tuple[float, float, float], clock: UnixClock,
    now_s: float,
) -> Iterator[Made]:  # fmt: skip
    """Yield scan, localization and waypoints, where the tick was given any."""
    if ranges is None and b'"localization":{' not in payload and b'"waypoints":[' not in payload:
        return
    inbox = json.loads(payload)["inbox"]
    scan, localization = inbox.get("scan"), inbox.get("localization")
    if scan is not None and ranges is not None:
        x_m, y_m, yaw_rad = lidar
        first_rad = scan["angle_min_rad"]
        last_rad = first_rad + scan["angle_increment_rad"] * max(0, len(ranges) // 8 - 1)
        taken_ns = clock.stamped_ns(scan["stamp_s"], now_s)
        placed = (x_m, y_m, _turn(yaw_rad))
        message = protobuf.laser_scan(taken_ns, "base", placed, (first_rad, last_rad), ranges)
        yield SCAN, message
    if localization is not None:
        at_ns = clock.stamped_ns(localization["stamp_s"], now_s)
        yield _transform(at_ns, "map", "odom", localization["odom_in_map"])
    for horizon in inbox.get("waypoints", ())[-1:]:
        poses = ",".join(
            _pose(point["x_m"], point["y_m"], point.get("heading_rad") or 0.0)
            for point in horizon["points"]
        )
        stamp = _time(clock.ns(now_s))
        yield PLAN, f'{{"timestamp":{stamp},"frame_id":"map","poses":[{poses}]}}'.encode()


def from_odometry(payload: bytes, clock: UnixClock, now_s: float) -> Made:
    """Return where ``base`` is in ``odom``."""
    said = json.loads(payload)
    return _transform(clock.stamped_ns(said["stamp_s"], now_s), "odom", "base",
                      said["base_in_odom"])  # fmt: skip


def from_status(payload: bytes, clock: UnixClock, now_s: float) -> Iterator[Made]:
    """Yield where the robot is in ``map``, while it knows."""
    here = json.loads(payload)["base_in_map"]
    if here is not None:
        stamp, pose = _time(clock.ns(now_s)), _pose(here["x_m"], here["y_m"], here["yaw_rad"])
        yield POSE, f'{{"timestamp":{stamp},"frame_id":"map","pose":{pose}}}'.encode()


def from_event(payload: bytes, clock: UnixClock, now_s: float) -> Made:
    """Return one line of the log."""
    said = json.loads(payload)
    level = _WARNING if any(mark in payload for mark in _GRAVE) else _INFO
    text = json.dumps(f"{said['code']} {said['detail']}".rstrip())
    stamp = _time(clock.ns(now_s))
    line = f'{{"timestamp":{stamp},"level":{level},"message":{text},"name":"bridge"'
    return LOG, (line + ',"file":"","line":0}').encode()


def _transform(at_ns: int, parent: str, child: str, pose: dict[str, Any]) -> Made:
    z, w = _turn(pose["yaw_rad"])
    text = (
        f'{{"timestamp":{_time(at_ns)},"parent_frame_id":"{parent}","child_frame_id":"{child}",'
        f'"translation":{{"x":{pose["x_m"]!r},"y":{pose["y_m"]!r},"z":0.0}},'
        f'"rotation":{{"x":0.0,"y":0.0,"z":{z!r},"w":{w!r}}}}}'
    )
    return TRANSFORMS, text.encode()


def _pose(x_m: float, y_m: float, yaw_rad: float) -> str:
    z, w = _turn(yaw_rad)
    return (
        f'{{"position":{{"x":{x_m!r},"y":{y_m!r},"z":0.0}},'
        f'"orientation":{{"x":0.0,"y":0.0,"z":{z!r},"w":{w!r}}}}}'
    )


def _turn(yaw_rad: float) -> tuple[float, float]:
    """Return z and w of the quaternion of a turn about the vertical."""
    return sin(yaw_rad / 2), cos(yaw_rad / 2)


def _time(at_ns: int) -> str:
    seconds, nanos = divmod(at_ns, _NS)
    return f'{{"sec":{seconds},"nsec":{nanos}}}'
