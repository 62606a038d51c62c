"""Look ahead: what an order would do at a robot, by that robot's own rehearsal."""

from __future__ import annotations

import asyncio
import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fleet.choice import is_named, place_names, steps_of
from fleet.link import RobotAway, RobotBusy, RobotRefusal

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from fleet.records import MissionRow
    from fleet.watch import RobotWatch

REHEARSAL_S = 4.0
AGAIN_S = 30.0
"""A robot that answered none in time is not asked meanwhile: all orders wait while one is."""
STANDS = frozenset({"say", "wait", "ask", "recall"})
"""Kinds of steps at which a robot stands still."""
Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Prospect:
    """Hold what an order would do at one robot."""

    length_m: float
    """Of its way; infinite where it is not known."""
    moves: bool
    """In doubt it does."""
    rooms: frozenset[str] | None
    """The ids of the rooms that its way leads through; None: its way is not known before."""


async def look_ahead(mission: MissionRow, watch: RobotWatch, card: Mapping[str, Any]) -> Prospect:
    """Return what a mission would do at a robot. An order as steps is no sentence to rehearse."""
    steps = steps_of(mission)
    if steps and {step.get("kind") for step in steps} <= STANDS:
        return Prospect(0.0, moves=False, rooms=frozenset())
    told: Mapping[str, Any] = {}
    if mission.text and time.monotonic() > watch.rehearses_again_s:
        try:
            async with asyncio.timeout(REHEARSAL_S):
                told = await watch.link.post("/v1/rehearsals", {"text": mission.text[:4000]})
            return _of_rehearsal(told, card)
        except (RobotAway, TimeoutError):
            watch.rehearses_again_s = time.monotonic() + AGAIN_S
        except (RobotBusy, RobotRefusal):
            pass
    return Prospect(_straight_m(mission.text, watch, card), moves=True, rooms=None)


def _of_rehearsal(told: Mapping[str, Any], card: Mapping[str, Any]) -> Prospect:
    steps: Sequence[Mapping[str, Any]] = told["steps"]
    does = {step["does"] for step in steps}
    points = [(x_m, y_m) for step in steps for x_m, y_m in step.get("points") or ()]
    named = {step["place"] for step in steps if step.get("place")}
    length_m = told.get("length_m")
    return Prospect(
        length_m=math.inf if "shut" in does or length_m is None else length_m,
        moves=not does <= {"stands"},
        rooms=None if does & {"open", "shut"} else frozenset(_rooms_of(points, named, card)),
    )


def _rooms_of(
    points: Collection[Point], named: Collection[str], card: Mapping[str, Any]
) -> Iterator[str]:
    """Yield the ids of rooms that a way has a point in, or that a step names."""
    for place in card.get("places") or ():
        outline = place.get("polygon")
        if place["id"] in named or (outline and any(is_inside(at, outline) for at in points)):
            yield place["id"]


def is_inside(at: Point, outline: Sequence[Sequence[float]]) -> bool:
    """Return whether a point lies in an outline [m], by the crossings of a ray."""
    x, y = at
    inside, (last_x, last_y) = False, (outline[-1][0], outline[-1][1])
    for next_x, next_y in outline:
        if (next_y > y) != (last_y > y):
            crossing = last_x + (y - last_y) / (next_y - last_y) * (next_x - last_x)
            inside ^= x < crossing
        last_x, last_y = next_x, next_y
    return inside


def _straight_m(order: str, watch: RobotWatch, card: Mapping[str, Any]) -> float:
    """Return the metres straight over the map to the place that an order names."""
    pose = (watch.told.get("status") or {}).get("base_in_map") or {}
    if watch.told.get("map_id") != card.get("map_id") or "x_m" not in pose:
        return math.inf
    text = order.casefold()
    for name, place in place_names(card):
        if is_named(name, text):
            at = place.get("pose") or {}
            return math.hypot(at.get("x_m", math.inf) - pose["x_m"],
                              at.get("y_m", math.inf) - pose["y_m"])  # fmt: skip
    return math.inf
