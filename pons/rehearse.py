"""Show what an order would do before it moves, and have it driven in the simulator."""

from __future__ import annotations

import json
import sys
import time
from typing import TYPE_CHECKING, Any

from pons import goals
from pons.http import PlannerDown, PlannerProblem, call
from pons.terminal import pick, pick_of

if TYPE_CHECKING:
    import argparse

    from pons.settings import LaunchSettings

PATH, DRIVE = "/v1/rehearsals", "/v1/rehearsals/drive"
POLL_S = 0.5
ROUTE_TIMEOUT_S = 30.0
"""A long plan is some searches for a way."""
EXIT_NOT_SO, EXIT_USAGE, EXIT_ENDED = 1, 2, 130
LEFT_OUT = {
    "localization": ("finding itself on the map", "在地图上定位自己"),
    "people_stand": ("people who walk", "走动的人"),
    "pictures": ("what it would see, hear or remember", "它会看到、听到或记得的"),
    "branches": ("conditions: each is taken to hold", "条件：都当作成立"),
    "rounds": ("rounds: each is driven once", "轮次：只行驶一次"),
    "waits": ("long waits: counted, not waited for", "长时间等待：只计入时间"),
    "nav2": ("Nav2: our own driving takes its place", "Nav2：由我们自己的行驶代替"),
}


def run(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Rehearse a sentence, or a goal's plan; 0 if all of it goes, 1 if something does not."""
    if bool(said.text) is (said.goal is not None):
        told = pick(
            "give a sentence, or a goal with --goal ID", "请给一句话，或用 --goal ID 指明任务"
        )
        print(f"no_order: {told}", file=sys.stderr)
        return EXIT_USAGE
    asked = {"text": " ".join(said.text)} if said.text else {"goal": said.goal}
    try:
        if said.drive:
            return _drive(settings, asked, as_json=said.json)
        shown = call(settings, "POST", PATH, asked, ROUTE_TIMEOUT_S)
    except (PlannerDown, PlannerProblem) as trouble:
        return goals.tell_trouble(trouble)
    if said.json:
        print(json.dumps(shown, ensure_ascii=False, indent=1))
    else:
        for step in shown["steps"]:
            print(_shown_line(step))
        print(_sum_line(shown))
    return EXIT_NOT_SO if any(step["does"] == "shut" for step in shown["steps"]) else 0


def _drive(settings: LaunchSettings, asked: dict[str, str], *, as_json: bool) -> int:
    """Have it driven, show how it goes, and what came of it; Ctrl-C cancels it."""
    told = call(settings, "POST", DRIVE, asked, ROUTE_TIMEOUT_S)
    counts = not as_json and sys.stdout.isatty()
    try:
        while told["state"] == "running":
            time.sleep(POLL_S)
            told = call(settings, "GET", DRIVE)
            if counts:
                print(f"\r\x1b[K  {_figures(told['driven'])}", end="", flush=True)
    except KeyboardInterrupt:
        call(settings, "DELETE", DRIVE)
        print(pick("\ncancelled; the robot did not move", "\n已取消；机器人没有移动"))
        return EXIT_ENDED
    if counts:
        print("\r\x1b[K", end="")
    if as_json:
        print(json.dumps(told, ensure_ascii=False, indent=1))
    else:
        _print_driven(told)
    fell = any(step["outcome"] not in ("succeeded", "left_out") for step in told["driven"]["steps"])
    return EXIT_NOT_SO if fell or told["state"] != "done" or told["driven"]["contacts"] else 0


def _print_driven(told: dict[str, Any]) -> None:
    driven, shown = told["driven"], told["shown"]
    for step in driven["steps"]:
        print(_driven_line(step))
    print(
        f"  {pick('in all', '共')} {_figures(driven)}; {pick('foretold', '预计')} {_figures(shown)}"
    )
    if told["message"]:
        print(f"  {told['code']}: {pick_of(told['message'])}")
    faster = told["times_faster"]
    if faster is not None:
        print(f"  {pick('driven in', '用时')} {told['took_s']:.1f} s, {faster:.1f} x")
    left = pick(", ", "、").join(
        pick(*LEFT_OUT.get(what, (what, what))) for what in told["left_out"]
    )
    print(f"  {pick('not simulated:', '未模拟：')} {left}")


def _step_name(step: dict[str, Any]) -> str:
    name = step["name"]
    what = step["kind"] if name is None else f"{step['kind']} {pick_of(name)}"
    return f"{step['index'] + 1}. {what}" + (
        pick(" (perhaps)", "（可能）") if step["branch"] else ""
    )


def _figures(of: dict[str, Any]) -> str:
    return f"{of['length_m']:.1f} m, {of['seconds']:.0f} s"


def _shown_line(step: dict[str, Any]) -> str:
    """Say in a line what a step would do."""
    if step["does"] == "open":
        told = pick("depends on what it sees or hears", "取决于看到或听到什么")
    elif step["does"] == "shut":
        told = f"{step['code']}: {pick_of(step['message'])}"
    else:
        narrow_m, told = step["narrowest_m"], _figures(step)
        if narrow_m is not None:
            told += pick(f", narrowest {narrow_m:.2f} m", f"，最窄 {narrow_m:.2f} m")
    return f"  {_step_name(step)}: {told}"


def _driven_line(step: dict[str, Any]) -> str:
    """Say in a line what came of a step in the simulator."""
    told = f"{step['outcome']}, {_figures(step)}"
    if step["outcome"] == "left_out":
        told = pick("left out: it hangs on what it sees or hears", "略过：取决于看到或听到什么")
    if step["nearest_m"] is not None:
        nearest_m = step["nearest_m"]
        told += pick(f", {nearest_m:.2f} m beside the nearest", f"，离最近的东西 {nearest_m:.2f} m")
    if step["contacts"]:
        told += pick(f", touched {step['contacts']} x", f"，碰到 {step['contacts']} 次")
    if step["rows"]:
        told += f", {' '.join(step['rows'])}"
    if step["code"]:
        told += f" ({step['code']}{': ' + pick_of(step['message']) if step['message'] else ''})"
    return f"  {_step_name(step)}: {told}"


def _sum_line(shown: dict[str, Any]) -> str:
    told = pick("; nothing has moved", "；什么也没有移动")
    rest = (
        ""
        if shown["is_whole"]
        else pick("; not all of it can be known before", "；不是全部都能预知")
    )
    return f"  {pick('in all', '共')} {_figures(shown)}{rest}{told}"
