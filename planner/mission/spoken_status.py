"""Say in both languages where the robot is and what it does, from the bridge's facts. Pure."""

from __future__ import annotations

from math import hypot

from planner.mission.account import place_name
from planner.mission.bridge_status import standing, worst_row
from planner.mission.outcomes import spot_at
from planner.mission.state import Mission, MissionState, SiteView
from planner.plan import Bilingual, Code, GoalState, message
from wire import Pose2, Status

NEAR_M = 1.0
OLD_S = 1.0
_SHOWN = 60
_PAUSED = {
    "operator": ("a person paused it", "由人暂停"),
    "stop": ("stop was pressed", "按下了停止"),
    "teleop": ("it was steered by hand", "被手动驾驶"),
    "estop": ("of a protective stop", "触发了保护性停止"),
    "budget": ("its distance or time is used up", "里程或时间已用完"),
    "blocked": ("the way is blocked", "去路被挡住"),
    "disarmed": ("the robot is disarmed", "机器人未解锁"),
    "planner_restarted": ("the planner was restarted", "规划器曾重启"),
}


STOPPED = message(Code.STOPPED)
STOPPING = Bilingual(en="Stopping: the bridge has confirmed it.", zh="正在停下：安全桥已确认。")


def stop_told(book: MissionState) -> Bilingual:
    """Say that a stop was confirmed; that the robot stands only where it does."""
    status = book.status
    return STOPPED if status is not None and standing(status) else STOPPING


def go_on_told(book: MissionState, said: Bilingual, now_s: float) -> Bilingual:
    """Say beside a refusal or a question that the robot is still on another goal, where it is."""
    running = book.missions.get(book.running or "")
    if running is None:
        return said
    text = _short(running.text)
    moves = book.status is not None and not standing(book.status)
    fresh = now_s - book.status_s <= OLD_S
    en = "I keep driving for" if moves and fresh else "I am still at"
    zh = "我仍在行驶，执行" if moves and fresh else "我仍在执行"
    return Bilingual(en=f"{said.en} {en} “{text}”.", zh=f"{said.zh}{zh}“{text}”。")


def where(book: MissionState, age_s: float) -> Bilingual:
    """Say where the robot is, or that nobody knows."""
    status = book.status
    if status is None:
        return Bilingual(
            en="I don't know where I am: the bridge has not been heard yet.",
            zh="我不知道自己在哪里：还没有收到安全桥的消息。",
        )
    pose = status.base_in_map
    if pose is None:
        return Bilingual(
            en="I don't know where I am: the localization is not good.",
            zh="我不知道自己在哪里：定位不可用。",
        )
    spot = _spot(book.facts, pose)
    if not age_s <= OLD_S:
        return Bilingual(
            en=f"The bridge is silent; {age_s:.0f} s ago I was {spot.en}.",
            zh=f"安全桥没有消息；{age_s:.0f} 秒前我在{spot.zh}。",
        )
    return Bilingual(en=f"I am {spot.en}.", zh=f"我在{spot.zh}。")


def _spot(facts: SiteView, pose: Pose2) -> Bilingual:
    room = spot_at(facts, pose).room
    near = min(
        (t for t in facts.targets.values() if not t.room),
        key=lambda t: hypot(t.pose.x_m - pose.x_m, t.pose.y_m - pose.y_m),
        default=None,
    )
    is_near = (
        near is not None and hypot(near.pose.x_m - pose.x_m, near.pose.y_m - pose.y_m) <= NEAR_M
    )
    by = near.name if near is not None and is_near else None
    inside = facts.targets[room].name if room is not None else None
    en = ", ".join(
        [*([f"in the {inside.en}"] if inside else []), *([f"by the {by.en}"] if by else [])]
    )
    zh = "，".join([*([inside.zh] if inside else []), *([f"{by.zh}旁边"] if by else [])])
    return Bilingual(en=en or "in no room that I know", zh=zh or "已知房间之外的地方")


def doing(book: MissionState, age_s: float, asking: str = "") -> Bilingual:
    """Say what the robot does now; the goal that asks (``asking``) is not counted."""
    motion = _motion(book.status, age_s)
    task = _task(book, asking)
    waiting = len([i for i in book.queue if i != asking])
    more = (
        Bilingual(en=f" {waiting} more in the queue.", zh=f"队列中还有 {waiting} 个任务。")
        if waiting
        else Bilingual(en="", zh="")
    )
    return Bilingual(en=f"{task.en} {motion.en}{more.en}", zh=f"{task.zh}{motion.zh}{more.zh}")


def _motion(status: Status | None, age_s: float) -> Bilingual:
    if status is None or not age_s <= OLD_S:
        return Bilingual(
            en="The bridge is silent, so nobody here knows whether I move.",
            zh="安全桥没有消息，无法确定我是否在移动。",
        )
    row = worst_row(status)
    why_en = f" ({row.row})" if row is not None else ""
    why_zh = f"（{row.row}）" if row is not None else ""
    if standing(status):
        return Bilingual(en=f"I stand still{why_en}.", zh=f"我现在停着{why_zh}。")
    speed = abs(status.measured.v_mps)
    return Bilingual(en=f"I move at {speed:.2f} m/s.", zh=f"我正以 {speed:.2f} 米/秒移动。")


def _task(book: MissionState, asking: str) -> Bilingual:
    running = book.missions.get(book.running or "")
    if running is not None:
        return _running(book, running)
    others = [m for m in book.missions.values() if not m.ended and m.id != asking]
    for state in (
        GoalState.PLANNING,
        GoalState.NEEDS_CLARIFICATION,
        GoalState.AWAITING_CONFIRMATION,
        GoalState.PAUSED,
    ):
        found = [m for m in others if m.state is state]
        if found:
            return _waiting(max(found, key=lambda m: m.order))
    return Bilingual(en="I have nothing to do.", zh="我现在没有任务。")


def _running(book: MissionState, mission: Mission) -> Bilingual:
    at, count = mission.step + 1, len(mission.steps)
    step = mission.steps[mission.step] if mission.step < count else None
    name = place_name(book.facts, mission, step) if step is not None else None
    goes = step is not None and step.kind in ("go_to", "return_home", "come_back")
    to = name if goes and name is not None else None
    text = _short(mission.text)
    return Bilingual(
        en=f"I do “{text}”, step {at} of {count}{f': to the {to.en}' if to else ''}.",
        zh=f"我正在执行“{text}”，第 {at} 步，共 {count} 步{f'：去{to.zh}' if to else ''}。",
    )


def _waiting(mission: Mission) -> Bilingual:
    text = _short(mission.text)
    if mission.state is GoalState.PLANNING:
        return Bilingual(en=f"I think about “{text}”.", zh=f"我正在考虑“{text}”。")
    if mission.state is GoalState.PAUSED:
        why = _PAUSED.get(mission.reason or "", (mission.reason or "", mission.reason or ""))
        return Bilingual(
            en=f"“{text}” is paused, because {why[0]}.", zh=f"“{text}”已暂停：{why[1]}。"
        )
    if mission.state is GoalState.AWAITING_CONFIRMATION:
        return Bilingual(en=f"“{text}” waits for your yes.", zh=f"“{text}”等待您确认。")
    return Bilingual(en=f"“{text}” waits for your answer.", zh=f"“{text}”等待您回答。")


def _short(text: str) -> str:
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"
