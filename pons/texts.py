"""Turn what the API answers into lines for a terminal. Knows no network."""

from __future__ import annotations

from typing import Any

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


def figures(outcome: Json | None) -> str:
    """Give the outcome's numbers: asked, reached, metres, seconds, what limited it."""
    if not outcome:
        return ""
    parts = []
    for name, unit in (("asked", ""), ("reached", ""), ("metres", " m"), ("seconds", " s")):
        value = outcome.get(name)
        if value is not None:
            shown = f"{value:.2f}" if isinstance(value, float) else str(value)
            parts.append(f"{name} {shown}{unit}")
    limited = outcome.get("limited_by")
    if limited:
        parts.append(f"limited by {limited if isinstance(limited, str) else ', '.join(limited)}")
    return "; ".join(parts)


def robot_lines(robot: Json) -> list[str]:
    """Describe the robot's state, what is up and what limits it."""
    status = robot.get("status")
    if not status:
        return ["bridge: no status heard"]
    pose = status.get("base_in_map")
    where = f"x {pose['x_m']:.2f} y {pose['y_m']:.2f} yaw {pose['yaw_rad']:.2f}" if pose else "?"
    owner = (status.get("owner") or {}).get("planner_id", "nobody")
    held = f", held ({status['held']['reason']})" if status.get("held") else ""
    limits = status["limits"]
    lines = [
        f"bridge: {status['mode']}{held}, epoch {status['epoch']}, owner {owner}",
        f"pose in map: {where}; room {robot.get('room') or '?'}",
        (
            f"speed asked {status['asked']['v_mps']:.2f} sent {status['sent']['v_mps']:.2f} "
            f"measured {status['measured']['v_mps']:.2f} m/s"
        ),
        f"limit {limits['v_mps']:.2f} m/s by {limits['by']}",
    ]
    if status["waiting_for"]:
        lines.append(f"waiting for: {', '.join(status['waiting_for'])}")
    lines += [f"row {row['row']} {row['action']}: {row['evidence']}" for row in status["rows"]]
    return lines
