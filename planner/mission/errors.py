"""Say why a request to the missions was not taken, by stable code, in both languages."""

from __future__ import annotations

from planner.plan import Bilingual, GoalState


class MissionError(Exception):
    """Refuse a request; nothing changed. ``code`` is stable, ``message`` is for people."""

    code = "mission_error"

    def __init__(self, en: str, zh: str) -> None:
        super().__init__(f"{self.code}: {en}")
        self.message = Bilingual(en=en, zh=zh)


class UnknownGoal(MissionError):
    """There is no goal of that id."""

    code = "unknown_goal"

    def __init__(self, goal_id: str, known: tuple[str, ...]) -> None:
        newest = ", ".join(known[-5:]) or "none"
        shown = goal_id[:64]
        super().__init__(
            f"no goal {shown!r}; newest goals: {newest}",
            f"没有编号为 {shown!r} 的任务；最近的任务：{newest}",
        )


class BadState(MissionError):
    """The goal is not in a state in which that can be asked."""

    code = "bad_state"

    def __init__(self, goal_id: str, what: str, state: GoalState, allowed: tuple[str, ...]) -> None:
        needs = ", ".join(allowed)
        super().__init__(
            f"can't {what} goal {goal_id}: it is {state.value}; expected {needs}",
            f"无法对任务 {goal_id} 执行 {what}：当前状态为 {state.value}，应为 {needs}",
        )


class NothingToResume(MissionError):
    """No goal is paused and none is kept waiting."""

    code = "nothing_to_resume"

    def __init__(self) -> None:
        super().__init__(
            "no goal is paused or kept waiting; give a new one",
            "没有已暂停或等待中的任务，请给出新任务",
        )


class QueueFull(MissionError):
    """As many goals wait as may wait."""

    code = "queue_full"

    def __init__(self, waiting: int) -> None:
        super().__init__(
            f"{waiting} goals are open, and no more are taken; cancel one or wait",
            f"已有 {waiting} 个未完成的任务，不再接受新任务；请取消一个或稍后再试",
        )


class IdempotencyConflict(MissionError):
    """The same Idempotency-Key came with another request."""

    code = "idempotency_conflict"

    def __init__(self, key: str, goal_id: str) -> None:
        super().__init__(
            f"the Idempotency-Key {key[:64]!r} belongs to goal {goal_id}, given with another body",
            f"Idempotency-Key {key[:64]!r} 已用于内容不同的任务 {goal_id}",
        )


class JournalDown(MissionError):
    """The journal cannot be written, so no goal may start."""

    code = "journal_unavailable"

    def __init__(self, why: str) -> None:
        super().__init__(
            f"the journal cannot be written ({why}); no goal is taken until it can",
            f"任务日志无法写入（{why}）；恢复之前不接受任务",
        )
