"""Turn the robot's own words into Foxglove's messages: one function for each topic.

Pure: a message or the planner's JSON in, a message of the SDK out. Frames are those of the
recordings (bridge/recording): map, odom, base, lidar.
"""

from __future__ import annotations

import base64
from math import cos, nan, sin
from typing import TYPE_CHECKING, Any

from foxglove import messages as fox

from wire.geometry import compose, inverse

if TYPE_CHECKING:
    from collections.abc import Iterable

    from wire import Pose2, Status
    from wire.lidar_config import LidarConfig
    from wire.sensors import Scan

Json = dict[str, Any]

_GREEN, _RED = fox.Color(r=0.1, g=0.6, b=0.3, a=0.9), fox.Color(r=0.85, g=0.15, b=0.1, a=0.9)
_AMBER, _INK = fox.Color(r=0.9, g=0.6, b=0.0, a=0.9), fox.Color(r=0.1, g=0.1, b=0.15, a=1.0)
_BLUE = fox.Color(r=0.1, g=0.4, b=0.9, a=0.8)
_CELLS = bytes((0, 100, 255))
"""Of a cell that is free, occupied, unknown: as nav_msgs/OccupancyGrid has it, -1 as a byte."""
_THING_M = 0.2
_NAME_PX, _NAME_M = 14.0, 0.25
_DRAWN_FENCE = (("allowed", _GREEN), ("keep_outs", _RED))


def pose_of(x_m: float, y_m: float, yaw_rad: float = 0.0, z_m: float = 0.0) -> fox.Pose:
    """Return a pose on the floor."""
    return fox.Pose(position=fox.Vector3(x=x_m, y=y_m, z=z_m), orientation=_turn(yaw_rad))


def _turn(yaw_rad: float) -> fox.Quaternion:
    return fox.Quaternion(x=0.0, y=0.0, z=sin(yaw_rad / 2), w=cos(yaw_rad / 2))


def scan(said: Scan, lidar: LidarConfig) -> fox.LaserScan:
    """Return a scan at its place on the robot; a beam without an echo is not a number."""
    ranges = [nan if one is None or one < said.range_min_m else one for one in said.ranges_m]
    width_rad = said.angle_increment_rad * max(0, len(ranges) - 1)
    return fox.LaserScan(
        frame_id="base",
        pose=pose_of(lidar.x_m, lidar.y_m, lidar.yaw_rad),
        start_angle=said.angle_min_rad,
        end_angle=said.angle_min_rad + width_rad,
        ranges=ranges,
    )


def transforms(status: Status) -> fox.FrameTransforms:
    """Return where base is in odom, and odom in map while that is known."""
    found = [_transform("odom", "base", status.base_in_odom)]
    if status.base_in_map is not None:
        odom_in_map = compose(status.base_in_map, inverse(status.base_in_odom))
        found.append(_transform("map", "odom", odom_in_map))
    return fox.FrameTransforms(transforms=found)


def _transform(parent: str, child: str, pose: Pose2) -> fox.FrameTransform:
    return fox.FrameTransform(
        parent_frame_id=parent,
        child_frame_id=child,
        translation=fox.Vector3(x=pose.x_m, y=pose.y_m, z=0.0),
        rotation=_turn(pose.yaw_rad),
    )


def pose(status: Status) -> fox.PoseInFrame | None:
    """Return where the robot is in map; None while it does not know."""
    here = status.base_in_map
    if here is None:
        return None
    return fox.PoseInFrame(frame_id="map", pose=pose_of(here.x_m, here.y_m, here.yaw_rad))


def speeds(status: Status) -> Json:
    """Return asked, sent and measured speeds, for plots."""
    return {
        f"{name}_{unit}": getattr(getattr(status, name), unit)
        for name in ("asked", "sent", "measured")
        for unit in ("v_mps", "w_radps")
    } | {"limit_v_mps": status.limits.v_mps, "limit_by": status.limits.by}


def ticks(status: Status) -> Json:
    """Return how late the bridge's ticks are, for plots."""
    told = status.ticks
    return {
        "late_p50_ms": told.late_p50_us / 1e3, "late_max_ms": told.late_max_us / 1e3,
        "step_max_ms": told.step_max_us / 1e3, "missed": told.missed, "ticks": told.ticks,
    }  # fmt: skip


def rows(status: Status) -> Json:
    """Return mode, leg and the rows in force."""
    return {
        "mode": status.mode.value,
        "held": None if status.held is None else status.held.reason,
        "rows": [row.model_dump(mode="json") for row in status.rows],
        "leg": None if status.leg is None else status.leg.model_dump(mode="json"),
    }


def route(path: Json | None) -> fox.PosesInFrame:
    """Return the running leg's whole way; empty while none is driven."""
    points = () if path is None else path["points"]
    return fox.PosesInFrame(frame_id="map", poses=[pose_of(x_m, y_m) for x_m, y_m in points])


def grid(told: Json) -> fox.Grid:
    """Return the map's cells as a grid of one byte a cell: 0 free, 100 occupied, 255 unknown."""
    cells = base64.b64decode(told["cells"])
    origin, size_m = told["origin"], told["resolution_m"]
    value = fox.PackedElementField(
        name="occupancy", offset=0, type=fox.PackedElementFieldNumericType.Uint8
    )
    return fox.Grid(
        frame_id="map",
        pose=pose_of(origin["x_m"], origin["y_m"]),
        column_count=told["width"],
        cell_size=fox.Vector2(x=size_m, y=size_m),
        row_stride=told["width"],
        cell_stride=1,
        fields=[value],
        data=cells.translate(_CELLS + bytes(range(3, 256))),
    )


def fence(record: Json) -> fox.SceneUpdate:
    """Return the fence: allowed ground green, forbidden red, slow zones amber."""
    drawn = [
        (f"{kind} {number}", ring, color)
        for kind, color in _DRAWN_FENCE
        for number, ring in enumerate(record.get(kind) or ())
    ]
    drawn += [
        (f"slow {number}", zone["polygon"], _AMBER)
        for number, zone in enumerate(record.get("speed_zones") or ())
    ]
    return _scene([_entity(name, lines=[_ring(ring, color)]) for name, ring, color in drawn])


def places(told: Iterable[Json], language: str = "en") -> fox.SceneUpdate:
    """Return rooms with their outline, and the names of all places."""
    entities = []
    for place in told:
        spot, name = place["pose"], place["name"].get(language) or place["id"]
        lines = [_ring(place["polygon"], _INK)] if place.get("polygon") else []
        entities.append(
            _entity(place["id"], lines=lines, texts=[_text(name, spot["x_m"], spot["y_m"])])
        )
    return _scene(entities)


def things(told: Iterable[Json]) -> fox.SceneUpdate:
    """Return what the camera has found, each where it stands."""
    entities = []
    for thing in told:
        cube = fox.CubePrimitive(
            pose=pose_of(thing["x_m"], thing["y_m"], z_m=thing["z_m"]),
            size=fox.Vector3(x=_THING_M, y=_THING_M, z=_THING_M),
            color=_BLUE,
        )
        label = _text(thing["name"]["en"], thing["x_m"], thing["y_m"], thing["z_m"] + _NAME_M)
        entities.append(_entity(str(thing["id"]), cubes=[cube], texts=[label]))
    return _scene(entities)


def boxes(look: Json | None) -> fox.ImageAnnotations:
    """Return the boxes of the newest look, in pixels of its picture."""
    points, texts = [], []
    for seen in () if look is None else look["boxes"]:
        left, top, right, bottom = map(float, seen["box"])
        corners = ((left, top), (right, top), (right, bottom), (left, bottom))
        points.append(
            fox.PointsAnnotation(
                type=fox.PointsAnnotationType.LineLoop,
                points=[fox.Point2(x=x, y=y) for x, y in corners],
                outline_color=_AMBER,
                thickness=2.0,
            )
        )
        texts.append(
            fox.TextAnnotation(
                position=fox.Point2(x=left, y=top),
                text=f"{seen['name']['en']} {seen['score']:.2f}",
                font_size=_NAME_PX,
                text_color=_AMBER,
                background_color=_INK,
            )
        )
    return fox.ImageAnnotations(points=points, texts=texts)


def _scene(entities: list[fox.SceneEntity]) -> fox.SceneUpdate:
    """Return a scene in place of the one before."""
    gone = fox.SceneEntityDeletion(type=fox.SceneEntityDeletionType.All)
    return fox.SceneUpdate(deletions=[gone], entities=entities)


def _entity(name: str, **drawn: Any) -> fox.SceneEntity:
    return fox.SceneEntity(frame_id="map", id=name, **drawn)


def _ring(ring: Iterable[tuple[float, float]], color: fox.Color) -> fox.LinePrimitive:
    return fox.LinePrimitive(
        type=fox.LinePrimitiveLineType.LineLoop,
        thickness=2.0,
        scale_invariant=True,
        points=[fox.Point3(x=float(x), y=float(y), z=0.0) for x, y in ring],
        color=color,
    )


def _text(text: str, x_m: float, y_m: float, z_m: float = 0.1) -> fox.TextPrimitive:
    return fox.TextPrimitive(
        pose=pose_of(x_m, y_m, z_m=z_m), billboard=True, font_size=_NAME_PX, scale_invariant=True,
        color=_INK, text=text,
    )  # fmt: skip
