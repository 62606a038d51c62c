"""Give the robot standing orders and look after them: ``pons orders [list|add|show|pause|resume|
skip|remove]``. Talks to the planner alone.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from pons.http import PlannerDown, PlannerProblem, call, tell_unreached

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
PATH = "/v1/orders"
ACTS = ("list", "add", "show", "pause", "resume", "skip", "remove")


def run(settings: LaunchSettings, act: str, words: list[str], *, as_json: bool = False) -> int:
    """Do one of the acts; 0 done, 2 bad order, 3 refused, 6 nobody answers."""
    what = " ".join(words).strip()
    if act != "list" and not what:
        needed = "the order as a sentence" if act == "add" else "its id, as pons orders shows it"
        print(f"no_order: pons orders {act} needs {needed}", file=sys.stderr)
        return EXIT_USAGE
    try:
        answer = _ask(settings, act, what)
    except PlannerProblem as refused:
        told = "\n".join(refused.told.values())
        print(f"refused: {refused}" + (f"\n{told}" if told else ""), file=sys.stderr)
        return EXIT_REFUSED
    except PlannerDown as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return EXIT_DOWN
    if as_json:
        print(json.dumps(answer, ensure_ascii=False, indent=1))
    else:
        print("\n".join(_lines(act, answer)))
    return EXIT_DONE


def _ask(settings: LaunchSettings, act: str, what: str) -> dict[str, Any]:
    if act == "list":
        return dict(call(settings, "GET", PATH))
    if act == "add":
        return dict(call(settings, "POST", PATH, {"text": what, "source": "cli"}))
    if act == "skip":
        what, _, day = what.partition(" ")
        one = f"{PATH}/{quote(what, safe='')}/skip"
        return dict(call(settings, "POST", one, {"day": day.strip()}))
    one = f"{PATH}/{quote(what, safe='')}"
    if act == "show":
        return dict(call(settings, "GET", one))
    if act == "remove":
        return dict(call(settings, "DELETE", one))
    return dict(call(settings, "POST", f"{one}/{act}", {}))


def _lines(act: str, answer: dict[str, Any]) -> list[str]:
    if act == "list":
        quiet = f", quiet hours {answer['quiet']}" if answer["quiet"] else ""
        head = f"{len(answer['orders'])} of {answer['most']}, times of {answer['timezone']}{quiet}"
        return [*map(_line, answer["orders"]), head]
    if act == "add":
        return [_in_language(answer, answer["told"]), _line(answer)]
    if act == "show":
        runs = [f"  next {run}" for run in answer["runs"]]
        return [_line(answer), *runs, *(f"  {_show_firing(answer, f)}" for f in answer["history"])]
    return [_line(answer)]


def _in_language(order: dict[str, Any], text: dict[str, str]) -> str:
    return text.get(order["language"], text["en"])


def _line(order: dict[str, Any]) -> str:
    state = "" if order["state"] == "active" else f" [{order['state']}]"
    due = f"; next {order['next']}" if order["next"] else ""
    counts = f"; fired {order['fired']}, missed {order['missed']}"
    when, does = _in_language(order, order["when"]), _in_language(order, order["does"])
    return f"{order['id']:<5}{state} {when}: {does}{due}{counts}"


def _show_firing(order: dict[str, Any], firing: dict[str, Any]) -> str:
    why = firing["reason"] or firing["code"] or ""
    often = f" × {firing['count']}" if firing["count"] > 1 else ""
    told = f": {_in_language(order, firing['told'])}" if firing["told"] else ""
    goal = f" ({firing['goal']})" if firing["goal"] else ""
    return f"{firing['due']} {firing['state']}{often} {why}{goal}{told}"
