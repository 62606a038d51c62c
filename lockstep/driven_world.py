"""Give goals to a world, as a person does. Nothing goes wrong here by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lockstep.goal_handle import GoalHandle
from lockstep.world import TooLong, World
from wire import MarksFile, Mode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lockstep.planner_process import Request
    from planner.brain import Brain
    from planner.plan import GoToPose, Language
    from planner.site.polygon import Polygon
    from wire import OpKind, SlowMark

READY_S = 20.0


class DrivenWorld(World):
    """Be one world. ``world.say(…)`` gives a goal; ``world.run_until(…)`` lets time pass."""

    def __init__(self, *, ready: bool = True, **parts: Any) -> None:
        """Put the parts together; :class:`World` lists them.

        Args:
            ready: run on until the robot is armed and owned, as ``pons up`` leaves it.
            parts: site, canvas, seed, brain, robot, hardware, domain, start, pace, step.

        Raises:
            TooLong: it did not become ready.
        """
        super().__init__(**parts)
        if ready:
            self.make_ready()

    # What a person does -------------------------------------------------------------------------

    def say(self, text: str, language: Language | None = None) -> GoalHandle:
        """Give a goal in words."""
        self.planner.say(text, language, self.now_s)
        return self.goal(f"goal-{self._goals}")

    def go(self, *points: GoToPose) -> GoalHandle:
        """Give a goal by points of the map, in a row."""
        self.planner.go(points, self.now_s)
        return self.goal(f"goal-{self._goals}")

    def draw(self, keep_outs: Sequence[Polygon] = (), slow: Sequence[SlowMark] = ()) -> Request:
        """Draw on the map, in place of all that was drawn before."""
        marks = MarksFile(
            version=1,
            map_id=self.scene.site.map_id,
            keep_outs=tuple(keep_outs),
            speed_zones=tuple(slow),
        )
        return self.planner.draw(marks, self.now_s)

    def goal(self, goal_id: str) -> GoalHandle:
        """Follow a goal that was given before: in a copy of a world, its own."""
        return GoalHandle(goal_id, lambda: self.planner.book)

    def think_with(self, brain: Brain) -> None:
        """Let another brain turn sentences into plans from now on."""
        self._brain = brain
        self.planner.think_with(brain)

    def stop(self, source: str = "cli") -> Request:
        """Order a stop through the API."""
        return self.planner.stop(source, self.now_s)

    def cancel(self, goal: GoalHandle) -> None:
        """End a goal."""
        self.planner.run(self.now_s, self.planner.missions.cancel(goal.id))

    def pause(self, goal: GoalHandle) -> None:
        """Keep a goal's place, standing."""
        self.planner.run(self.now_s, self.planner.missions.pause(goal.id))

    def resume(self, goal: GoalHandle) -> None:
        """Go on with a goal; clears the bridge's hold as the API's handler does."""
        self.planner.resume(goal.id, self.now_s)

    def answer(self, goal: GoalHandle, text: str) -> None:
        """Answer a goal's question."""
        self.planner.answer(goal.id, text, self.now_s)

    def operate(self, kind: OpKind, limit_s: float = 5.0) -> Request:
        """Make an operator's request and run until the bridge answered.

        Raises:
            TooLong: it did not.
        """
        self.run_until(lambda _: self.planner.status is not None, limit_s)
        request = self.planner.operate(kind, self.now_s)
        if request is None:
            raise TooLong("no status to sign for")
        self.run_until(lambda _: request.answer is not None, limit_s)
        return request

    def make_ready(self, limit_s: float = READY_S) -> None:
        """Arm once the self test has passed and the planner owns the robot, as ``pons up`` does."""
        self.run_until(
            lambda w: (
                w.bridge.statuses
                and w.status.mode is Mode.DISARMED
                and w.status.owner is not None
                and w.status.base_in_map is not None
            ),
            limit_s,
        )
        end_s = self.now_s + limit_s
        while self.status.mode is Mode.DISARMED:
            self.operate("arm")
            self.run(0.1)
            if self.now_s > end_s:
                raise TooLong(f"not armed; {self.describe()}")
        self.run_until(lambda w: w.status.mode is Mode.HOLD, limit_s)
