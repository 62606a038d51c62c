"""Stand exactly on the edge of each window: what began at 0 s is judged when its window is over.

Elsewhere tests keep a millionth away from an edge; here the very number counts, so that no ``<``
can become ``<=`` unseen.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from bridge.core.authority import ownership, requests
from bridge.core.faults import detectors, fault_latch
from bridge.core.faults.detectors import brain, commands
from bridge.core.inbox import LoopFacts
from bridge.core.modes import mode_logic, teleop
from bridge.core.modes.operator import ready_lacks, reset_lacks
from bridge.core.motion import motion_gates
from bridge.core.sensing import sensor_update
from bridge.core.state import RowUp
from bridge.core.state_motion import Gate
from bridge.core.state_orders import External
from bridge.core.tick_context import TickContext
from tests.bridge.core.modes.test_mode_logic_stops import stop_of
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table
from wire import Mode, Pose2

Judge = Callable[[TickContext], object]


def rows(
    detector: Callable[[TickContext, list[tuple[str, str]]], None],
) -> Callable[[TickContext], list[str]]:
    def judge(tick: TickContext) -> list[str]:
        dirty: list[tuple[str, str]] = []
        detector(tick, dirty)
        return [name for name, _ in dirty]

    return judge


def owner(echo_s: float, used_s: float | None = None) -> Judge:
    """Let the owner have shown so much; a status of 0 s is what it has seen last."""

    def judge(tick: TickContext) -> object:
        tick.s.ownership = replace(tick.s.ownership, echo_s=echo_s, used_s=used_s)
        tick.s.leg = replace(tick.s.leg, horizon=None)
        return rows(brain)(tick)

    return judge


def followed(tick: TickContext) -> object:
    tick.s.leg = replace(tick.s.leg, sent_s=0.0)
    return [tick.s.leg.has_usable_horizon(tick.s.grants.mission, tick.now_s), *rows(commands)(tick)]


def external(tick: TickContext) -> object:
    tick.s.leg = replace(tick.s.leg, horizon=None)
    tick.s.external = External(0.1, 0.0, dead_man=True, sent_s=0.0)
    return rows(commands)(tick)


def spent_bucket(tick: TickContext) -> object:
    tick.s.leg = replace(tick.s.leg, horizon=None)
    tick.s.bad_bucket = 5.0
    return rows(commands)(tick)


def alive(tick: TickContext) -> object:
    tick.s.ownership = replace(tick.s.ownership, echo_s=0.0)
    return ownership.is_alive(tick)


def cleaned(tick: TickContext) -> object:
    tick.s.rows = {"LIDAR_STALE.0": RowUp(0.0, 0.0, "old")}
    fault_latch.update(tick, [])
    return list(tick.s.rows)


def renewed(tick: TickContext) -> object:
    tick.s.operator = replace(tick.s.operator, nonce_made_s=0.0)
    before = tick.s.operator.nonce_no
    requests.renew_nonce(tick)
    return tick.s.operator.nonce_no - before


def old_nonce(tick: TickContext) -> object:
    old = {"old_nonce_no": 0, "old_tag": "c", "old_until_s": tick.now_s}
    tick.s.operator = replace(tick.s.operator, **old)  # type: ignore[arg-type]  # names of its fields
    text = requests.old_nonce_text(tick)
    return list(requests.bad_proof(tick, "arm", "a1", text, authentic=True))


def held(received_s: float, sent_s: float) -> Judge:
    def judge(tick: TickContext) -> object:
        tick.s.stick = replace(tick.s.stick, received_s=received_s, sent_s=sent_s)
        teleop.watch(tick)
        return tick.s.mode

    return judge


def arming(**state: object) -> Judge:
    def judge(tick: TickContext) -> object:
        tick.s.drive.still_since_s, tick.s.drive.received_s = tick.now_s - 9.0, tick.now_s
        if "pressed_s" in state:
            tick.s.stick = replace(tick.s.stick, pressed_s=0.0)
        if "row" in state:
            tick.s.rows = {str(state["row"]): RowUp(0.0, 0.0, "seen")}
        return [code for code, _ in ready_lacks(tick)]

    return judge


def reset(**state: object) -> Judge:
    def judge(tick: TickContext) -> object:
        tick.s.drive.still_since_s, tick.s.drive.received_s = tick.now_s - 9.0, tick.now_s
        tick.s.buttons = replace(tick.s.buttons, pressed_s=0.0 if "pressed_s" in state else None)
        tick.s.rows = {str(state["row"]): RowUp(0.0, 0.0, "seen")} if "row" in state else {}
        return [code for code, _ in reset_lacks(tick)]

    return judge


def measured(tick: TickContext) -> object:
    tick.s.drive.received_s = 0.0
    return not mode_logic._is_unmeasured(tick)


def slow(tick: TickContext) -> object:
    tick.s.drive.still_since_s = None
    tick.s.stopping = stop_of(-1.0, slow_s=0.14)
    tick.s.odometry = replace(tick.s.odometry, measured=reached("active").state.odometry.measured)
    return mode_logic._failure(tick)


def shut(tick: TickContext) -> object:
    yaw_rad = tick.s.odometry.base_in_odom.yaw_rad
    tick.s.gate = Gate(shut_s=0.49, shut_yaw_rad=yaw_rad)
    motion_gates._note(tick, "obstacle")
    return tick.s.gate.blocked


def turned_away(tick: TickContext) -> object:
    tick.s.odometry = replace(tick.s.odometry, base_in_odom=Pose2(0.0, 0.0, 0.05))
    tick.s.gate = Gate(shut_s=0.3, shut_yaw_rad=0.0)
    motion_gates._note(tick, "obstacle")
    return tick.s.gate.shut_s


def late(count: int, within: str) -> Judge:
    def judge(tick: TickContext) -> object:
        if within == "late_at_s":
            tick.s.loop = replace(tick.s.loop, late_at_s=(0.0,) * count)
            tick.inbox = replace(tick.inbox, loop=LoopFacts(late_s=1.0))
        else:
            tick.s.loop = replace(tick.s.loop, gaps_at_s=(0.0,) * count)
            tick.dt_s = 0.2
        sensor_update.note_lateness(tick)
        return rows(detectors.loop)(tick)

    return judge


def waits(must_stop: bool) -> Judge:
    def judge(tick: TickContext) -> object:
        tick.s.waits_since_s = 0.0
        tick.s.rows = {"LIDAR_STALE.0": RowUp(0.0, 0.0, "old")}
        tick.s.gate = Gate(blocked=not must_stop)
        mode_logic.expire_holding(tick, must_stop=must_stop)
        return tick.s.grants.mission

    return judge


CASES: tuple[tuple[str, float, Judge, object], ...] = (
    ("active", 0.15, owner(echo_s=0.0), []),
    ("active", 0.3, owner(echo_s=0.0), ["BRAIN_LATE.0"]),
    ("active", 5.0, owner(echo_s=0.0), ["BRAIN_LOST.0"]),
    ("active", 1.0, owner(echo_s=1.0, used_s=0.0), []),
    ("active", 0.5, followed, [True]),
    ("active", 0.25, external, []),
    ("active", 0.25, spent_bucket, ["CMD_BAD.0"]),
    ("active", 0.3, alive, True),
    ("active", 1.0, cleaned, []),
    ("disarmed", 60.0, renewed, 1),
    ("disarmed", 10.0, old_nonce, []),
    ("teleop", 0.25, held(0.0, 0.25), Mode.TELEOP),
    ("teleop", 0.4, held(0.4, 0.0), Mode.TELEOP),
    ("disarmed", 0.25, arming(pressed_s=0.0), ["stick_not_neutral"]),
    ("disarmed", 2.0, arming(row="RUNAWAY.0"), ["runaway"]),
    ("fault", 2.0, reset(pressed_s=0.0), []),
    ("fault", 2.0, reset(row="RUNAWAY.0"), []),
    ("stopping_by_row", 0.25, measured, True),
    ("stopping_by_row", 0.15, slow, "stop_too_slow"),
    ("active", 0.5, shut, True),
    ("active", 0.2, turned_away, 0.01),
    ("active", 1.0, late(4, "late_at_s"), ["LOOP_LATE.0"]),
    ("active", 10.0, late(2, "gaps_at_s"), ["LOOP_LATE.1", "LOOP_LATE.2"]),
    ("hold_granted", 30.0, waits(True), None),
    ("hold_granted", 300.0, waits(False), None),
)


@table(("start", "now_s", "judge", "expected"), CASES)
def test_on_the_edge(start: str, now_s: float, judge: Judge, expected: object) -> None:
    tick = tick_of(reached(start))
    tick.now_s = now_s
    assert judge(tick) == expected
