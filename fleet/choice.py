"""Choose who goes: by what each can do, by its way, and in turn."""

from __future__ import annotations

import asyncio
import math
import re
from typing import TYPE_CHECKING, Any

from fleet.link import RobotAway, RobotBusy, RobotRefusal

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fleet.records import MissionRow
    from fleet.watch import RobotWatch

REHEARSAL_S = 4.0


def place_names(card: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield each name of each place on a card, folded, with the place."""
    for place in card.get("places") or ():
        names = [str(place.get("id", "")).replace("_", " "), *(place.get("name") or {}).values()]
        for aliases in (place.get("aliases") or {}).values():
            names += aliases
        for name in names:
            if folded := str(name).casefold().strip():
                yield folded, place


def is_named(name: str, text: str) -> bool:
    """Return whether a sentence has a place's name in it, as a word where words have spaces."""
    if not name.isascii():
        return name in text
    return re.search(rf"(?<![a-z0-9]){re.escape(name)}(?![a-z0-9])", text) is not None


def is_able(order: str, robot: str, cards: Mapping[str, Mapping[str, Any]]) -> bool:
    """Return whether a robot knows each place of an order that any robot knows.

    A place that nobody knows is left to the robot to tell.
    """
    text = order.casefold()
    known = {name for card in cards.values() for name, _ in place_names(card)}
    wanted = {name for name in known if is_named(name, text)}
    return wanted <= {name for name, _ in place_names(cards[robot])}


async def rank(
    mission: MissionRow,
    watches: Sequence[RobotWatch],
    cards: Mapping[str, Mapping[str, Any]],
    used: Mapping[str, int],
) -> list[str]:
    """Return the robots, the one that should go first.

    By the metres of its way where the nearest is asked for: those of the robot's own rehearsal;
    else straight over the map to the place; else, as for anybody, who was sent longest ago.
    """  # fmt: skip
    metres: dict[str, float] = {}
    if mission.way == "nearest" and len(watches) > 1:
        found = await asyncio.gather(*(_way_m(mission, watch, cards) for watch in watches))
        metres = {watch.name: m for watch, m in zip(watches, found, strict=True)}
    names = [watch.name for watch in watches]
    return sorted(names, key=lambda name: (metres.get(name, 0.0), used.get(name, 0), name))


async def _way_m(
    mission: MissionRow, watch: RobotWatch, cards: Mapping[str, Mapping[str, Any]]
) -> float:
    """Return the metres of a robot's way; infinite where they are not known."""
    try:
        async with asyncio.timeout(REHEARSAL_S):
            told = await watch.link.post("/v1/rehearsals", {"text": mission.text[:4000]})
        if all(step.get("does") != "shut" for step in told["steps"]):
            return float(told["length_m"])
    except (RobotAway, RobotBusy, RobotRefusal, TimeoutError, KeyError, TypeError, ValueError):
        pass
    return _straight_m(mission.text, watch, cards[watch.name])


def _straight_m(order: str, watch: RobotWatch, card: Mapping[str, Any]) -> float:
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
