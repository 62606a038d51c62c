"""List what the robot was told, show one goal whole, tell what happens: ``pons goals``, ``log``.

Asks the planner alone; ``log`` polls its list, so that it needs no library and survives restarts.
"""

from __future__ import annotations

import json
import sys
import time
from datetime import datetime, timedelta
from typing import TYPE_CHECKING, Any
from urllib.parse import quote, urlencode

from pons.http import PlannerDown, PlannerProblem, call, fetch_text, tell_unreached
from pons.terminal import paint, pick, pick_of, refusal
from pons.terminal_text import step_line

if TYPE_CHECKING:
    import argparse
    from pathlib import Path

    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_NOTHING, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 1, 2, 3, 6
PATH = "/v1/history"
PAGE = 200
"""The most that the planner tells at once."""
PAGE_S = 25.0
"""The planner has the black box read for it by a process."""
POLL_S = 0.5
_COLOURS = {"succeeded": "green", "failed": "red", "refused": "red", "running": "blue"}


def run(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Be ``pons goals``: 0 shown, 1 nothing found, 2 bad order, 3 refused, 6 nobody answers."""
    try:
        if said.goal is not None:
            return _show_one(settings, said)
        if said.html is not None:
            print("html_of_what: name the goal: pons goals GOAL --html FILE", file=sys.stderr)
            return EXIT_USAGE
        goals = _collect(settings, _question(said), said.most)
    except ValueError as wrong:
        print(f"bad_day: {wrong}; expected YYYY-MM-DD", file=sys.stderr)
        return EXIT_USAGE
    except (PlannerDown, PlannerProblem) as trouble:
        return _tell(trouble)
    if said.json:
        print(json.dumps({"goals": goals}, ensure_ascii=False, indent=1))
        return EXIT_DONE
    day = ""
    for goal in goals:
        given = datetime.fromtimestamp(goal["created_unix_s"])  # noqa: DTZ006  # a person's own clock
        if (of := f"{given:%Y-%m-%d %A}") != day:
            day = of
            print(paint(day, "bold"))
        print(_line(goal, given))
    if not goals:
        print(pick("no such goal", "没有这样的任务"))
    return EXIT_DONE if goals else EXIT_NOTHING


def _question(said: argparse.Namespace) -> dict[str, Any]:
    """Return the list's question. Raises ValueError: the day is none."""
    asked: dict[str, Any] = {"state": said.state, "search": said.search}
    if said.day is not None:
        begins = datetime.fromisoformat(said.day)
        asked["since_unix_s"] = begins.timestamp()
        asked["until_unix_s"] = (begins + timedelta(days=1)).timestamp()
    return {name: value for name, value in asked.items() if value is not None}


def _collect(settings: LaunchSettings, asked: dict[str, Any], most: int) -> list[dict[str, Any]]:
    """Return the newest goals that are asked for, page by page."""
    goals: list[dict[str, Any]] = []
    asked = dict(asked)
    while len(goals) < most:
        asked["limit"] = max(1, min(PAGE, most - len(goals)))
        page = call(settings, "GET", f"{PATH}?{urlencode(asked)}")
        goals += page["goals"]
        if page["next"] is None:
            break
        asked["before"] = page["next"]
    return goals


def _line(goal: dict[str, Any], given: datetime) -> str:
    state = paint(f"{goal['state']:<10}", _COLOURS.get(goal["state"], "yellow"))
    lasted = "" if goal["seconds"] is None else f"{goal['seconds']:.0f} s"
    way = f"{goal['metres']:.1f} m" if goal["metres"] else ""
    return f"{given:%H:%M:%S}  {state} {lasted:>6} {way:>8}  {goal['id']}  {goal['text']!r}"


def _show_one(settings: LaunchSettings, said: argparse.Namespace) -> int:
    path = f"{PATH}/{quote(said.goal, safe='')}"
    if said.html is not None:
        return _write_page(settings, path, said.html)
    told = call(settings, "GET", path)
    print(json.dumps(told, ensure_ascii=False, indent=1) if said.json else "\n".join(_lines(told)))
    return EXIT_DONE


def _write_page(settings: LaunchSettings, path: str, file: Path) -> int:
    """Write a goal as one HTML file; 0 done, 2 the file can't be written."""
    language = pick("en", "zh")
    page = fetch_text(settings, f"{path}/page?language={language}", timeout_s=PAGE_S)
    try:
        file.write_text(page, "utf-8")
    except OSError as error:
        print(f"file_unwritable: {file}: {error.strerror}", file=sys.stderr)
        return EXIT_USAGE
    print(pick(f"wrote {file}", f"已写入 {file}"))
    return EXIT_DONE


def _lines(told: dict[str, Any]) -> list[str]:
    """Return a goal with its story for a terminal."""
    goal, story, spent = told["goal"], told["story"], told["usage"]["goal"]
    lines = [f"{goal['id']}  {goal['state']}  {goal['text']!r}", f"  by {story['source']}"]
    for change in story["changes"]:
        at = datetime.fromtimestamp(change["at_unix_s"])  # noqa: DTZ006  # a person's own clock
        lines.append(f"  {at:%Y-%m-%d %H:%M:%S}  {change['state']}")
    steps = (goal.get("plan") or {}).get("steps") or []
    lines += [step_line(number, step) for number, step in enumerate(steps, 1)]
    questions = [*story["questions"], *("" for _ in story["replies"][len(story["questions"]) :])]
    for asked, answer in zip(questions, story["replies"], strict=False):
        lines.append(f"  {asked} -> {answer}")
    if goal.get("outcome"):
        lines.append(f"  {pick_of(goal['outcome']['message'])}")
    lines.append(f"  {story['metres']:.2f} m driven")
    if spent and spent["calls"]:
        money = told["usage"]["currency"]
        price = f", {spent['money']:.4f} {money}" if money else ""
        lines.append(f"  {spent['calls']} calls of {told['usage']['model']}{price}")
    return lines


def log(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Be ``pons log``: tell the last goals, and with -f each change as it comes."""
    seen: dict[str, str] = {}
    try:
        while True:
            try:
                newest = _collect(settings, {}, 20)
            except PlannerDown:
                if not seen:
                    raise
                newest = []  # it is restarting
            for goal in reversed(newest):
                if seen.get(goal["id"]) != goal["state"]:
                    seen[goal["id"]] = goal["state"]
                    print(_event(goal, as_json=said.json), flush=True)
            if not said.follow:
                return EXIT_DONE
            time.sleep(POLL_S)
    except KeyboardInterrupt:
        return EXIT_DONE
    except (PlannerDown, PlannerProblem) as trouble:
        return _tell(trouble)


def _event(goal: dict[str, Any], *, as_json: bool) -> str:
    if as_json:
        return json.dumps(goal, ensure_ascii=False)
    at_unix_s = goal["created_unix_s"] + (goal["seconds"] or 0.0)
    when = datetime.fromtimestamp(at_unix_s)  # noqa: DTZ006  # a person's own clock
    state = paint(f"{goal['state']:<10}", _COLOURS.get(goal["state"], "yellow"))
    told = pick_of(goal["told"]) or (goal["reason"] or "")
    return f"{when:%Y-%m-%d %H:%M:%S}  {state} {goal['text']!r}" + (f": {told}" if told else "")


def _tell(trouble: PlannerDown | PlannerProblem) -> int:
    if isinstance(trouble, PlannerProblem):
        print(f"refused: {refusal(trouble, trouble.told)}", file=sys.stderr)
        return EXIT_REFUSED
    print(tell_unreached(trouble), file=sys.stderr)
    return EXIT_DOWN
