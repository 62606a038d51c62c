"""Give goals to a world and make things go wrong in it. The class that tests and benches use."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sim.site import pose2
from sim.site.objects import LEAF
from tools.lockstep.eyes import PerceptionProcess
from tools.lockstep.goal_handle import GoalHandle
from tools.lockstep.truth_detector import TruthFinder
from tools.lockstep.world import TooLong, World
from wire import MarksFile, Mode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.brain import Brain
    from planner.brain.image_questions import Looker
    from planner.plan import GoToPose, Language
    from planner.site.polygon import Polygon
    from tools.lockstep.disturbance import Disturbance
    from tools.lockstep.planner_process import Request
    from tools.lockstep.truth_detector import Finder
    from wire import OpKind, Pose2, SlowMark

READY_S = 20.0


class LockstepWorld(World):
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

    def open_eyes(
        self, finder: Finder | None = None, looker: Looker | None = None
    ) -> PerceptionProcess:
        """Let the planner see from now on, by the simulator's truth or by another finder.

        Args:
            finder: finds things in pictures.
            looker: a vision model that is asked about pictures; only where eyes open first.
        """
        if self.eyes is None:
            camera, seed = self.scene.robot.camera, self.seed
            self.eyes = PerceptionProcess(self.scene, finder or TruthFinder(camera, seed))
            self.looker = looker
            self.planner.see_with(self.eyes, looker)
        elif finder is not None:
            self.eyes.look_with(finder)
        return self.eyes

    # What goes wrong ----------------------------------------------------------------------------

    def kill_planner(self) -> None:
        """End the planner at once; what it had said is still on its way."""
        if self._planner is not None:
            self._planner.leave()
        self._planner = None

    def kill_bridge(self) -> None:
        """End the bridge at once; the base is on its own."""
        self.bridge_lives = False

    def freeze_planner(self) -> None:
        """Hold the planner as SIGSTOP does."""
        self._frozen = True

    def thaw_planner(self) -> None:
        """Let the planner go on as SIGCONT does."""
        self._frozen = False

    def silence_localization(self, *, silent: bool = True) -> None:
        """Take the localization's word away, or give it back."""
        self._localizing = not silent

    def disturb(self, disturbance: Disturbance) -> None:
        """Spoil messages from now on."""
        self.bus.disturb(disturbance)

    def calm(self) -> None:
        """Spoil messages no more."""
        self.bus.calm()

    def place_obstacle(self, x_m: float, y_m: float, yaw_rad: float = 0.0) -> None:
        """Stand a person or a crate in the home, in ``map``."""
        self.sim.place_obstacle(x_m, y_m, yaw_rad)

    def remove_obstacle(self) -> None:
        """Take it away again."""
        self.sim.remove_obstacle()

    def put(self, name: str, pose: Pose2 | None) -> None:
        """Put a person or an object of the home somewhere, or take it away."""
        self.sim.place_thing(name, pose)

    def shut_door(self, one: str, other: str, *, shut: bool = True) -> None:
        """Shut the leaf of the door between two rooms, or open it; its own script may go on.

        Raises:
            ConfigError: ``obstacle_unknown``: that door has no leaf; ``Domain(doors=16)`` hangs
                one in each door of the home, and ``door_open_s=0.0`` leaves them to the test.
        """
        between = {one, other}
        doors = enumerate(self.sim.home.doors)
        number = next((at for at, door in doors if set(door.between) == between), -1)
        name = f"{LEAF}{number}"
        declared = self.sim.things.declared.get(name)
        self.sim.place_thing(name, declared if shut else None)

    def stand_on(self, place_id: str, name: str = "person_0") -> None:
        """Put a person, or another thing of the home, onto a place or into a room's middle."""
        home = self.sim.home
        pose = home.rooms[place_id].pose if place_id in home.rooms else home.places[place_id].pose
        self.sim.place_thing(name, pose2(pose))

    def teleport(self, base_in_map: Pose2) -> None:
        """Carry the robot somewhere; its wheels notice nothing."""
        self.sim.place_robot(base_in_map)
