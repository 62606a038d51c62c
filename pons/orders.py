"""Give the robot standing orders and look after them: ``pons orders [list|add|show|pause|resume|
skip|remove|export|import]``. Talks to the planner alone.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from pons.http import PlannerDown, PlannerProblem, call, fetch_text, tell_unreached
from pons.terminal import pick, pick_of, refusal

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
PATH, CALENDAR = "/v1/orders", "/v1/orders.ics"
THINKING_S = 60.0
"""Each order of a file is thought about."""
ACTS = ("list", "add", "show", "pause", "resume", "skip", "remove", "export", "import")


def run(settings: LaunchSettings, act: str, words: list[str], *, as_json: bool = False) -> int:
    """Do one of the acts; 0 done, 2 bad order, 3 refused, 6 nobody answers."""
    what = " ".join(words).strip()
    if act not in ("list", "export") and not what:
        needed = {"add": "the order as a sentence", "import": "an iCalendar file"}.get(
            act, "its id, as pons orders shows it"
        )
        print(f"no_order: pons orders {act} needs {needed}", file=sys.stderr)
        return EXIT_USAGE
    try:
        if act == "export":
            sys.stdout.write(fetch_text(settings, CALENDAR))
            return EXIT_DONE
        if act == "import":
            return _import(settings, what)
        answer = _ask(settings, act, what)
    except PlannerProblem as refused:
        print(f"refused: {refusal(refused, refused.told)}", file=sys.stderr)
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


def _import(settings: LaunchSettings, file: str) -> int:
    """Show what a calendar file would have kept, and keep it after a yes."""
    try:
        text = Path(file).read_text("utf-8")
    except (OSError, ValueError) as error:
        print(f"no_file: {file}: {error}", file=sys.stderr)
        return EXIT_USAGE
    body = {"calendar": text, "source": "cli"}
    told = call(settings, "POST", CALENDAR, body, THINKING_S)
    for each in told["proposed"]:
        skipped = f" (not on {', '.join(each['skipped'])})" if each["skipped"] else ""
        print(f"{pick_of(each['when'])}{skipped}: {pick_of(each['does'])}  [{each['name']}]")
    for each in told["refused"]:
        why = pick_of(each["message"])
        print(f"refused {each['name']}: {each['code']}: {why}", file=sys.stderr)
    if not told["proposed"]:
        return EXIT_REFUSED
    count = len(told["proposed"])
    print(pick(f"Keep these {count}? [y/N] ", f"要保留这 {count} 项吗？[y/N] "), end="", flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes", "是"):
        return EXIT_REFUSED
    kept = call(settings, "POST", CALENDAR, {**body, "agreed": told["agree"]}, THINKING_S)["kept"]
    print(f"kept {', '.join(kept)}")
    return EXIT_DONE


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
