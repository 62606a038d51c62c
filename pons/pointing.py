"""Send the robot to a point of its map, or to a place by its name: ``pons go``."""

from __future__ import annotations

import json
import sys
from difflib import get_close_matches
from math import radians
from typing import TYPE_CHECKING, Any

from pons import goals
from pons.http import PlannerDown, PlannerProblem, call
from pons.terminal import pick
from pons.terminal_text import goal_line

if TYPE_CHECKING:
    import argparse

    from pons.settings import LaunchSettings

EXIT_USAGE = 2
MOST_NUMBERS = 3


def run(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Give the goal and follow it to its end, unless told not to."""
    try:
        body, language = _goal_of(settings, said.where, said.map)
        if body is None:
            return EXIT_USAGE
        given = {**body, "source": goals.SOURCE, **({"replace": True} if said.replace else {})}
        goal = call(settings, "POST", "/v1/goals", given)
    except (PlannerDown, PlannerProblem) as trouble:
        return goals.tell_trouble(trouble)
    if not said.json:
        print(goal_line(goal), flush=True)
    elif said.no_wait:
        print(json.dumps(goal, ensure_ascii=False, indent=1))
    if said.no_wait:
        return 0
    return goals.follow(settings, goal["id"], language, as_json=said.json)


def _goal_of(
    settings: LaunchSettings, where: list[str], map_id: str | None
) -> tuple[dict[str, Any] | None, str]:
    """Return the goal of these words, and its language; None after saying what is wrong."""
    numbers = _numbers(where)
    if numbers is None:
        return _to_place(settings, " ".join(where))
    if not 2 <= len(numbers) <= MOST_NUMBERS:
        told = pick("give X and Y in metres, and a heading in degrees or none",
                    "请给出 X 和 Y（米），航向（度）可省略")  # fmt: skip
        print(f"no_point: {told}", file=sys.stderr)
        return None, "en"
    if map_id is None:
        map_id = (call(settings, "GET", "/v1/robot").get("status") or {}).get("map_id")
    if map_id is None:
        told = pick("the robot knows no map now; name one with --map",
                    "机器人现在没有地图；请用 --map 指明")  # fmt: skip
        print(f"no_map: {told}", file=sys.stderr)
        return None, "en"
    point: dict[str, float] = {"x_m": numbers[0], "y_m": numbers[1]}
    if len(numbers) == MOST_NUMBERS:
        point["yaw_rad"] = radians((numbers[2] + 180.0) % 360.0 - 180.0)
    language = pick("en", "zh")
    return {"points": [point], "map_id": map_id, "language": language}, language


def _numbers(words: list[str]) -> list[float] | None:
    """Return the words as numbers; None where the first is none: they name a place then."""
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def _to_place(settings: LaunchSettings, name: str) -> tuple[dict[str, Any] | None, str]:
    """Return the goal of driving to a place by its id or a name, in the language of that name."""
    names: dict[str, tuple[str, str]] = {}
    for place in call(settings, "GET", "/v1/places")["places"]:
        for language in ("zh", "en"):
            told, also = place["name"][language], place.get("aliases", {}).get(language, ())
            for one in (told, *also, *([place["id"]] if language == "en" else [])):
                names[str(one).casefold()] = (language, str(told))
    found = names.get(name.casefold())
    if found is None:
        near = get_close_matches(name.casefold(), names, n=3, cutoff=0.5)
        hint = pick("`pons places` lists them", "`pons places` 列出所有地点")
        if near:
            hint = pick("did you mean ", "您是说 ") + " / ".join(near) + "?"
        print(f"unknown_place: {name!r}; {hint}", file=sys.stderr)
        return None, "en"
    language, told = found
    return {"text": f"去{told}" if language == "zh" else f"go to the {told}"}, language
