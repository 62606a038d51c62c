"""Teach the robot places and forget them: ``pons places [list|export] | remember|forget NAME``.

Talks to the planner alone: it knows where the robot stands, and what may be a name.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from pons.http import PlannerDown, PlannerProblem, call, tell_unreached
from pons.terminal import pick_of, refusal

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
PATH = "/v1/places"
_KEPT = ("id", "name", "pose", "map_id", "by", "taught")
"""What places.json holds of each."""


def run(
    settings: LaunchSettings,
    act: str,
    name: str | None,
    *,
    chinese: str | None = None,
    as_json: bool = False,
) -> int:
    """Do one of the acts; 0 done, 2 bad order, 3 refused, 6 nobody answers."""
    if act in ("remember", "forget") and name is None and (chinese is None or act == "forget"):
        print(f"no_name: say which place to {act}", file=sys.stderr)
        return EXIT_USAGE
    try:
        if act == "remember":
            _tell("remembered", _remember(settings, name, chinese), as_json=as_json)
        elif act == "forget":
            path = f"{PATH}/{quote(name or '', safe='')}"
            _tell("forgotten", call(settings, "DELETE", path), as_json=as_json)
        elif act == "export":
            _export(settings)
        elif as_json:
            print(json.dumps(call(settings, "GET", PATH), ensure_ascii=False, indent=1))
        else:
            _list(settings)
    except PlannerProblem as refused:
        print(f"refused: {refusal(refused, refused.told)}", file=sys.stderr)
        return EXIT_REFUSED
    except PlannerDown as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return EXIT_DOWN
    return EXIT_DONE


def _list(settings: LaunchSettings) -> None:
    known = call(settings, "GET", PATH)
    own = [place for place in known["places"] if place["id"] not in _ids(known["taught"])]
    for place in own:
        print(f"{place['id']:<24} {_names(place)}")
    for place in known["taught"]:
        why = f"; not used: {pick_of(place['message'])}" if place["why_not"] else ""
        print(f"{place['id']:<24} {_names(place)}  {_origin(place)}{why}")
    here = sum(place["why_not"] != "other_map" for place in known["taught"])
    print(f"{here} of {known['most']} taught on this map")


def _export(settings: LaunchSettings) -> None:
    """Print what was taught as places.json, which a planner takes in at its start."""
    taught = call(settings, "GET", PATH)["taught"]
    places = [{name: place[name] for name in _KEPT} for place in taught]
    print(json.dumps({"version": 1, "places": places}, ensure_ascii=False, indent=1))


def _remember(settings: LaunchSettings, name: str | None, chinese: str | None) -> dict[str, Any]:
    given = {"en": name, "zh": chinese}
    names = {language: said for language, said in given.items() if said is not None}
    return dict(call(settings, "POST", PATH, {"name": names, "source": "cli"}))


def _tell(done: str, place: dict[str, Any], *, as_json: bool) -> None:
    where = f"  {_origin(place)}" if done == "remembered" else ""
    shown = f"{done} {place['id']}: {_names(place)}{where}"
    print(json.dumps(place, ensure_ascii=False, indent=1) if as_json else shown)


def _ids(taught: list[dict[str, Any]]) -> set[str]:
    return {place["id"] for place in taught if not place["why_not"]}


def _names(place: dict[str, Any]) -> str:
    en, zh = place["name"]["en"], place["name"]["zh"]
    return str(en) if en == zh else f"{en} / {zh}"


def _origin(place: dict[str, Any]) -> str:
    """Say where and by whom a place was taught; the minute is enough."""
    pose, when = place["pose"], place["taught"][:16].replace("T", " ")
    at = f"({pose['x_m']:.2f}, {pose['y_m']:.2f}) m"
    return f"at {at}, map {place['map_id']}, taught by {place['by']} on {when} UTC"
