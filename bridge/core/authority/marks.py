"""Put in force what people drew on the map: where to stay out, and where to go slowly.

Marks only take away from the fence of fence.json, so they may come and go while the robot drives;
like a fence they need an operator's proof of their very text. Outlines are read, prepared and
written beside the loop, which answers by :class:`FenceDone`; here is judged, in the tick in which
they are to count, whether the robot can still stop before them. Knows no file.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.requests import bad_proof, settle, use_nonce, verdict_on
from bridge.core.geometry.stopping import reaction_s, stop_length_m
from bridge.core.state_orders import PendingMarks
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.geometry.fence import FenceGrid
    from bridge.core.inbox import FenceArrival, FenceDone
    from bridge.core.tick_context import TickContext

KIND = "marks"
POSE_S = 0.1
"""Localization's period, as at the gate: by so much the pose may be late."""
SLACK_M = 0.05
"""What the pose may be wrong by, beside what the stop takes."""


def hear_marks(tick: TickContext, arrived: FenceArrival) -> None:
    """Take one request, or give it its verdict; one id gets one verdict."""
    asked = tick.s.marks.asked
    if verdict_on(tick, KIND, arrived.id) is not None:
        return
    if asked is not None and asked.id == arrived.id:
        return  # being prepared; it is repeated until then
    refusal = next(_against(tick, arrived), None)
    if refusal is not None:
        settle(tick, KIND, arrived.id, *refusal)
        return
    use_nonce(tick, KIND, arrived.id)
    asked = PendingMarks(arrived.id, arrived.source, arrived.text)
    tick.s.marks = replace(tick.s.marks, asked=asked)
    tick.say("marks_asked", f"by {arrived.source}")


def hear_marks_done(tick: TickContext, done: FenceDone) -> None:
    """Put prepared marks in force, unless the robot could not stop before them any more."""
    marks = tick.s.marks
    asked, fence = marks.asked, tick.config.fence
    if asked is None or asked.id != done.id or fence is None:
        return
    code, detail = done.code, done.detail
    if code == "ok":
        code, detail = _against_place(tick, fence.with_marks(asked.text)) or (code, detail)
    settle(tick, KIND, done.id, code, detail)
    if code != "ok":
        tick.s.marks = replace(marks, asked=None)
        tick.say("marks_refused", f"{code}: {detail}")
        return
    tick.s.marks = replace(
        marks, text=asked.text, hash=fingerprint(asked.text.encode()), asked=None
    )
    tick.say("marks_accepted", f"by {asked.source}: {detail}")


def _against(tick: TickContext, arrived: FenceArrival) -> Iterator[tuple[str, str]]:
    """Yield code and detail of each objection to a request; the first one decides."""
    if tick.stopped:
        yield "stopped", "a stop came in the same tick; ask again"
    yield from bad_proof(tick, KIND, arrived.id, arrived.nonce, authentic=arrived.authentic)
    if tick.s.marks.asked is not None:
        yield "marks_busy", "other marks are being put in force; ask again"
    if tick.config.fence is None:
        yield "fence_missing", "there is no fence that marks could take away from"


def _against_place(tick: TickContext, marked: FenceGrid) -> tuple[str, str] | None:
    """Return why marks can't count with the robot where it is; None where they can.

    A robot that is outside of what is allowed already is brought nearer to nothing by them.
    """
    here, fence = tick.robot_in_map, tick.fence
    if here is None or fence is None or not fence.allows(here.x_m, here.y_m):
        return None
    at, margin_m = f"({here.x_m:.2f}, {here.y_m:.2f})", marked.margin_m(here.x_m, here.y_m)
    if not margin_m >= 0.0:
        return "mark_holds_robot", f"the robot is at {at}, inside of one; send it out first"
    robot, learnt = tick.config.robot, tick.s.learnt
    lag_s = robot.drive.late_s + learnt.lag_more_s
    reaction = reaction_s(0.0, POSE_S, lag_s, robot.limits)
    moves = tick.s.odometry.measured
    length_m = stop_length_m(moves, robot.base, robot.limits, reaction, learnt.decel_share)
    if not tick.still_for(0.0) and not margin_m >= length_m + SLACK_M:
        text = f"the robot is at {at}, {margin_m:.2f} m before one, and needs {length_m:.2f} m"
        return "mark_too_near", f"{text} to stop; stop it first, or draw farther away"
    return None
