"""Turn the API's answers into lines for a terminal. Knows no network."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from pons.terminal import pick, pick_of

Json = dict[str, Any]

FINAL_STATES = frozenset({"succeeded", "failed", "refused", "cancelled"})
WAITING_STATES = frozenset({"needs_clarification", "awaiting_confirmation", "paused"})


def message(outcome: Json | None, language: str) -> str:
    """Return the outcome's sentence in the language of the person."""
    texts = (outcome or {}).get("message") or {}
    return str(texts.get(language) or texts.get("en") or "")


def step_line(number: int, step: Json) -> str:
    """Describe one step and how it went."""
    what = " ".join(
        str(step[name]) for name in ("kind", "place", "object", "seconds", "text") if step.get(name)
    )
    reason = f" ({step['reason']})" if step.get("reason") else ""
    return f"  {number}. {what}: {step.get('state', '?')}{reason}"


def goal_line(goal: Json) -> str:
    """Describe a goal in one line."""
    reason = f" ({goal['reason']})" if goal.get("reason") else ""
    return f"{goal['id']}  {goal['state']}{reason}  {goal['text']!r}"


def how_to_answer(goal: Json, language: str) -> str:
    """Say how a goal that waits for a person is answered from a shell; nothing for any other."""
    goal_id, options = goal["id"], (goal.get("plan") or {}).get("options") or []
    if goal["state"] == "awaiting_confirmation":
        yes, no = f"pons confirm {goal_id}", f"pons answer {goal_id} no"
        return f"是：{yes}；否：{no}" if language == "zh" else f"yes: {yes}; no: {no}"
    if goal["state"] != "needs_clarification":
        return ""
    how = f"pons answer {goal_id}"
    if len(options) == 1:
        return f"{how} {'好的|不用|…' if language == 'zh' else 'yes|no|…'}"
    return f"{how} {'您的回答' if language == 'zh' else 'TEXT'}"


def figures(outcome: Json | None) -> str:
    """Give the outcome's numbers: request, result, metres, seconds, limits."""
    if not outcome:
        return ""
    spots = ((name, outcome.get(name)) for name in ("asked", "reached"))
    parts = [f"{name} {named}" for name, spot in spots if spot and (named := place(spot))]
    for name, unit in (("metres", "m"), ("seconds", "s")):
        if (value := outcome.get(name)) is not None:
            parts.append(f"{name} {value:.2f} {unit}")
    limited = outcome.get("limited_by")
    if limited:
        parts.append(f"limited by {limited if isinstance(limited, str) else ', '.join(limited)}")
    return "; ".join(parts)


def place(spot: Json) -> str:
    """Name a spot: its place or else its room, and where it is in ``map`` [m]; a turn has none."""
    named = str(spot.get("place") or spot.get("room") or "")
    x_m, y_m = spot.get("x_m"), spot.get("y_m")
    return named if x_m is None or y_m is None else f"{named or '?'} ({x_m:.2f}, {y_m:.2f})"


def stand_in(goal: Json, language: str) -> str:
    """Say that another brain than the model planned, and why; nothing where none did."""
    brain = goal.get("brain") or {}
    if not brain.get("fallback_from"):
        return ""
    why = (brain.get("fallback_message") or {}).get(language) or brain.get("fallback_reason", "")
    if language == "zh":
        return f"{brain['name']} 代替 {brain['fallback_from']} 规划：{why}"
    return f"{brain['name']} planned in place of {brain['fallback_from']}: {why}"


WEAK_BRAKES = (
    (
        "The brakes reach less than half of what robot.toml says, so every speed is capped. Mend "
        "them, then end `pons up` and run `pons braking forget`, or measure again by "
        "`pons calibrate`."
    ),
    (
        "制动力不足设定的一半，速度已受限。修好后请结束 `pons up` 并运行 "
        "`pons braking forget`，或用 `pons calibrate` 重新标定。"
    ),
)


def braking_line(braking: Json) -> str:
    """Give the braking that the gates count on."""
    source = f"learnt from {braking['stops']} stops" if braking["learnt"] else "configured"
    trouble = f" ({braking['trouble']})" if braking["trouble"] else ""
    return (
        f"braking: {source}, lag {braking['lag_s']:.3f} s, "
        f"deceleration {braking['decel_mps2']:.2f} m/s2{trouble}"
    )


WITHOUT_POSE = MappingProxyType(
    {
        "searching": (
            "The robot is looking for where it is, and stands still meanwhile.",
            "机器人正在寻找自己的位置，期间停着不动。",
        ),
        "lost": (
            'The robot does not know where it is and stands still: say "you are in the kitchen".',
            "机器人不知道自己在哪里，停着不动。可以对它说“你在厨房”。",
        ),
    }
)
"""The first lines about a robot whose localizer has no pose, by what the localizer does."""


def _other_map(robot: Json) -> list[str]:
    """Tell that localization uses another map than the rest: its files changed under way."""
    theirs, ours = robot.get("localized_map"), robot.get("map_id")
    if theirs is None or theirs == ours:
        return []
    return [
        pick(
            f"The robot stands still: localization uses map {theirs}, the others {ours}. The map's "
            "files were changed meanwhile: end `pons up` and start it again.",
            f"机器人停着不动：定位使用地图 {theirs}，其余进程使用 {ours}。"
            "地图文件在运行中被更换：请结束 `pons up` 后重新启动。",
        )
    ]


def robot_lines(robot: Json) -> list[str]:
    """Describe the robot's state, the rows that are up and its limits."""
    status = robot.get("status")
    if not status:
        return ["bridge: no status heard"]
    pose = status.get("base_in_map")
    where = f"x {pose['x_m']:.2f} y {pose['y_m']:.2f} yaw {pose['yaw_rad']:.2f}" if pose else "?"
    owner = (status.get("owner") or {}).get("planner_id", "nobody")
    held = f", held ({_holder_line(status['held'])})" if status.get("held") else ""
    limits = status["limits"]
    lines = [
        f"bridge: {status['mode']}{held}, epoch {status['epoch']}, owner {owner}",
        f"pose in map: {where}; room {robot.get('room') or '?'}",
        (
            f"speed asked {status['asked']['v_mps']:.2f} sent {status['sent']['v_mps']:.2f} "
            f"measured {status['measured']['v_mps']:.2f} m/s"
        ),
        f"limit {limits['v_mps']:.2f} m/s by {limits['by']}",
        braking_line(status["braking"]),
    ]
    without_pose = WITHOUT_POSE.get(robot.get("localizer") or "", ("", ""))
    trouble = robot.get("localizer_trouble")
    told = pick(*without_pose) if trouble is None else pick_of(trouble["message"])
    lines = [*_other_map(robot), *filter(None, [told]), *lines]
    if limits["by"] == "weak_brakes":
        lines.append(pick(*WEAK_BRAKES))
    lines += _trouble(status)
    lines += [f"row {row['row']} {row['action']}: {row['evidence']}" for row in status["rows"]]
    return lines


def _holder_line(held: Json) -> str:
    """Name the robot's holder; a fault by its cause."""
    reason = str(held["reason"])
    return f"fault: {held['id']}" if reason == "fault" else reason


def _trouble(status: Json) -> list[str]:
    """Tell the robot's open waits, holds and refusals, and the remedies."""
    codes, held = status["waiting_for"], status.get("held") or {}
    refused = [
        answer
        for answer in status["answers"]
        if answer["kind"] in {"hello", "grant"} and not answer["accepted"]
    ]
    by_fault = held.get("reason") == "fault"
    if not (codes or refused or by_fault):
        return []
    from pons.code_messages import (
        code_lines,
        lack_lines,
    )  # late: what a healthy robot says needs no tables

    faulty = status["mode"] == "FAULT"
    lines = [f"{'fault' if faulty else 'waiting for'}: {', '.join(codes)}"] if codes else []
    for code in codes:
        lines += code_lines(code) if faulty else lack_lines(code)
    if by_fault and held["id"] not in codes:
        lines += code_lines(held["id"])
    for answer in refused:
        who = f"refused {answer['kind']} of {answer['id']}"
        lines.append(f"{who}: {answer['code']}: {answer['detail']}")
        lines += code_lines(answer["code"])
    return lines
