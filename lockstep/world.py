"""Put a whole robot into one process on a simulated clock, let time pass, look at it.

Every tick of 10 ms each part takes its turn in a fixed order: robot, localization, bridge, planner.
Deterministic: same site, seed, calls give the same commands. Nothing here sleeps or reads a clock.
"""

from __future__ import annotations

from heapq import heappop, heappush
from typing import TYPE_CHECKING, Any, Self, cast

from bridge.core import CoreConfig, step
from localization.node import StandInNode
from localization.standin import StandIn
from lockstep.bridge_process import BridgeProcess, Step
from lockstep.bus import LockstepBus
from lockstep.latencies import TICK_S, Pace, ticks
from lockstep.planner_process import Notebook, PlannerProcess
from lockstep.robot_process import RobotProcess
from lockstep.scene import folder_of, scene
from planner.brain import OfflineBrain
from sim import Domain, Hardware, SimRobot
from wire import RobotDescription
from wire.keys import Party
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from lockstep.parts import LineBase, Turning, WorldEyes
    from lockstep.scene import LockstepScene
    from planner.brain import Brain
    from planner.brain.image_questions import Looker
    from sim.site import Home
    from wire import DriveCommand, Pose2, Status, Twist2
    from wire.session import Session

START_S = 1_000.0
"""Where every part's monotonic clock begins: not at zero, which would hide a missing time."""
STAND_IN_ROBOT = RobotDescription(localization=LocalizationConfig(kind="stand_in"))
"""The default robot, told where it is: halls without a feature tell a localizer nothing, and most
that is tried here is not about the pose."""


class TooLong(Exception):
    """The awaited event did not come within its simulated time."""


class World:
    """Hold the parts of one world and turn them."""

    bridge_lives = True
    """False from its kill on: nothing is sent to the wheels any more."""

    def __init__(  # noqa: PLR0913  # a world's parts, all by name
        self,
        *,
        site: Path | str = "two_room",
        canvas: Path | None = None,
        plain: LockstepScene | None = None,
        home: Home | None = None,
        seed: int = 1,
        brain: Brain | None = None,
        robot: RobotDescription | None = None,
        hardware: Hardware | None = None,
        domain: Domain | None = None,
        start: Pose2 | None = None,
        pace: Pace | None = None,
        step: Step = step,
    ) -> None:
        """Put the parts together.

        Args:
            site: a site's folder, or the name of one of the checkout's own.
            canvas: the folder in which a map of it is made by driving; None: the map is known.
            plain: what the parts read of the site, where it is not what lies in its folder.
            home: what stands there, likewise.
            seed: of all noise and of what varies on the wire.
            brain: what turns sentences into plans; the offline brain if None. It answers at once.
            robot: its description; the default robot if None. It says what localizes.
            hardware: what the simulated robot is really like.
            domain: the knobs of ``pons up --domain``; all neutral if None.
            start: where the robot stands at first; the site's dock if None.
            pace: how long messages, routes, plans and the disk take.
            step: the bridge's core, or a wrapper that measures it.
        """
        self.pace, self.seed = pace or Pace(), seed
        self.scene = plain or scene(canvas or folder_of(site), robot or STAND_IN_ROBOT)
        latency = {frozenset({Party.PLANNER, Party.BRIDGE}): self.pace.planner_bridge}
        self.bus = LockstepBus(seed, latency)
        self.sim = SimRobot(
            folder_of(site), self.scene.robot, seed=seed, start=start,
            hardware=hardware, domain=domain, home=home,
        )  # fmt: skip
        self.base = self._base()
        self._robot = RobotProcess(self.sim, self.bus.port(Party.ROBOT), self.base)
        self.lidar = self._lidar()
        self._localization = self._localize(seed)
        self.bridge = self._bridge(step)
        self.notebook = Notebook()
        self._brain: Brain = brain or OfflineBrain()
        self._planner: PlannerProcess | None = None
        self._planners = 0
        self._goals = 0
        self._frozen = False
        self._localizing = True
        self.eyes: WorldEyes | None = None
        self.looker: Looker | None = None
        self._hooked = 0
        self._hooks: list[tuple[int, int, Callable[[Any], None]]] = []
        self.start_planner()

    def start_planner(self) -> None:
        """Start a planner with a new id on the journal of those before."""
        self._planners += 1
        self._frozen = False
        self._planner = PlannerProcess(
            self.scene,
            self.bus.port(Party.PLANNER),
            self._brain,
            self.pace,
            self.notebook,
            f"planner-{self._planners}",
            self._new_goal_id,
            self.now_s,
        )
        if self.eyes is not None:
            self._planner.see_with(self.eyes, self.looker)

    def _new_goal_id(self) -> str:
        self._goals += 1
        return f"goal-{self._goals}"

    @property
    def planner(self) -> PlannerProcess:
        """Return the planner that lives now.

        Raises:
            TooLong: there is none; it was killed.
        """
        if self._planner is None:
            raise TooLong("the planner was killed; start_planner() starts another")
        return self._planner

    @property
    def waits(self) -> bool:
        """Tell whether a living planner waits for what it was promised."""
        return self._planner is not None and self._planner.waits

    # Time ---------------------------------------------------------------------------------------

    @property
    def tick_count(self) -> int:
        """Return how many ticks have passed."""
        return self.bus.tick

    @property
    def now_s(self) -> float:
        """Return the time on every part's monotonic clock [s]."""
        return START_S + self.bus.tick * TICK_S

    def _clock(self) -> float:
        return self.now_s

    def tick(self) -> None:
        """Let one tick pass."""
        self.bus.tick += 1
        now_s = self.now_s
        while self._hooks and self._hooks[0][0] <= self.bus.tick:
            heappop(self._hooks)[2](self)
        self._robot.turn(now_s)
        if self.lidar is not None:
            self.lidar.turn(now_s)
        if self._localizing and self.bus.tick % self.pace.localization_period == 0:
            self._localization.turn(now_s)
        if self.bridge_lives:
            self.bridge.turn(now_s)
        if self._planner is not None and not self._frozen:
            self._planner.turn(now_s)
            self._planner.look(self.sim, now_s)

    def run(self, seconds: float) -> None:
        """Let simulated time pass [s]."""
        for _ in range(ticks(seconds)):
            self.tick()

    def run_until(self, done: Callable[[Self], object], limit_s: float = 60.0) -> float:
        """Let time pass until something holds; return how long that took [s].

        Raises:
            TooLong: it did not hold within the limit; the message says where everything stands.
        """
        for count in range(ticks(limit_s) + 1):
            if done(self):
                return count * TICK_S
            self.tick()
        raise TooLong(f"not within {limit_s} simulated seconds; {self.describe()}")

    def at(self, tick: int, act: Callable[[Self], None]) -> None:
        """Do something at the beginning of a tick: a kill, a freeze, an obstacle."""
        self._hooked += 1
        heappush(self._hooks, (tick, self._hooked, act))

    # What can be seen ---------------------------------------------------------------------------

    @property
    def truth(self) -> Pose2:
        """Return where the robot truly is, in ``map``."""
        return self.sim.base_in_map

    @property
    def twist(self) -> Twist2:
        """Return how it truly moves."""
        return self.sim.twist

    @property
    def contacts(self) -> int:
        """Return how often the robot touched something since start."""
        return self.sim.contacts_total

    @property
    def status(self) -> Status:
        """Return what the bridge said last.

        Raises:
            TooLong: it has not spoken yet.
        """
        if not self.bridge.statuses:
            raise TooLong("the bridge has not spoken yet; let a tick pass")
        return self.bridge.statuses[-1]

    @property
    def statuses(self) -> Sequence[Status]:
        """Return the newest statuses, oldest first."""
        return self.bridge.statuses

    @property
    def commands(self) -> Sequence[DriveCommand | None]:
        """Return the command of each tick, oldest first; None where none was sent."""
        return self.bridge.commands

    @property
    def room(self) -> str | None:
        """Return the room that the robot truly is in."""
        room = self.scene.site.room_at(self.truth.x_m, self.truth.y_m)
        return room.id if room is not None else None

    @property
    def standing(self) -> bool:
        """Tell whether the robot truly stands."""
        return abs(self.twist.v_mps) < 0.02 and abs(self.twist.w_radps) < 0.05

    def describe(self) -> str:
        """Say in one line where everything stands."""
        status = self.bridge.statuses[-1] if self.bridge.statuses else None
        if status is None:
            return f"tick {self.tick_count}, the bridge has not spoken"
        rows = [f"{row.row}:{row.action.value} ({row.evidence})" for row in status.rows]
        goals = [
            f"{goal.id} {goal.state.value} {goal.reason or ''}".strip()
            for goal in (self.planner.book.missions.values() if self._planner else ())
        ]
        pose = f"({self.truth.x_m:.2f}, {self.truth.y_m:.2f}, {self.truth.yaw_rad:.2f})"
        return (
            f"tick {self.tick_count}, {status.mode.value}, at {pose}, held {status.held}, "
            f"owner {status.owner}, rows {rows}, waits for {status.waiting_for}, goals {goals}, "
            f"leg {status.leg}, reasons {self.bridge.reasons}"
        )

    def _base(self) -> LineBase | None:
        """Return a base that speaks on a line; None: commands come by the wire."""
        return None

    def _lidar(self) -> Turning | None:
        """Return a lidar that speaks on a line; None: the simulator's own scans."""
        return None

    def _bridge(self, step: Step) -> BridgeProcess:
        drive = self.base.drive if self.base else None
        port = self.bus.port(Party.BRIDGE)
        return BridgeProcess(self._config(self.seed), port, step, self.now_s, drive)

    def _localize(self, seed: int) -> Turning:
        """Return what says where the robot is: the truth and a little noise."""
        port = self.bus.port(Party.LOCALIZATION)
        stand_in = StandIn(self.scene.site.map_id, seed=seed)
        return StandInNode(stand_in, cast("Session", port))

    def _config(self, seed: int) -> CoreConfig:
        return CoreConfig(
            robot=self.scene.robot,
            robot_hash=self.scene.robot.hash,
            fence=self.scene.fence,
            fence_hash=self.scene.fence_hash,
            map_id=self.scene.site.map_id,
            boot=f"lockstep{seed}",
            period_s=TICK_S,
        )
