"""Stage meetings of a robot and a polite person in the hallway of the default home.

In lockstep; localization is by scans. The hallway is 1.4 m wide between its walls, so that two who
keep to its middle stand before each other. They have met once a metre or less is between their
rims; it is solved once each is a metre on the other's far side. Judged on the simulator's truth.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from random import Random
from typing import TYPE_CHECKING

from planner.plan import GoalState
from pons.settings import CHECKOUT
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld
from tools.lockstep.walkers import Manner, Walker
from wire import Pose2, RobotDescription
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "stand_offs"
TITLE = "robot and polite person meet in a hallway of 1.4 m"
LONG_ONLY = True
SITE = CHECKOUT / "sites" / "home"
MEETINGS = 50
MIDDLE_M, ASIDE_M = 4.75, 0.35
"""Across the hallway: its middle, and how far from it the person begins at most."""
EAST = (("entrance", "bedroom"), (2.3, 4.0), (8.4, 9.2), (1.2, 2.0))
WEST = (("kitchen", "living room"), (8.4, 10.0), (2.8, 3.6), (10.0, 10.8))
"""Of a robot that drives east or west: its goals, and along the hallway where it begins, where the
person begins and where they walk to [m]."""
MET_M, APART_M = 1.0, 1.0
SOLVED_S = 20.0
LIMIT_S = 150.0


@dataclass(slots=True)
class Meeting:
    """Hold what one meeting came to."""

    met: bool = False
    solved_s: float | None = None
    """From having met until each is past the other."""
    reached: bool = False
    took_s: float = 0.0
    contacts: int = 0
    recoveries: tuple[str, ...] = ()


def measure(lab: BenchLab) -> list[ReportRow]:
    """Stage 50 meetings in a long run, 2 in a quick one; one processor a meeting."""
    count = lab.count(2, MEETINGS)
    told = [Meeting(**one) for one in lab.side_by_side("meeting", count, meet)]
    met = [one for one in told if one.met]
    took = [one.solved_s for one in met if one.solved_s is not None]
    quick = [one_s for one_s in took if one_s <= SOLVED_S]
    note = f"{len(met)} of {len(told)} met; {len(took)} solved at all"
    contacts = sum(one.contacts for one in told)
    share = [100.0 * len(quick) / len(met)] if met else []
    return [
        row_of("stand-offs solved within 20 s", "%", "48 of 50", share, note),
        row_of("met -> past each other", "s", "", took),
        ReportRow("goals reached", "", "", value=str(sum(one.reached for one in told))),
        ReportRow("contacts", "", "0", value=str(contacts), note=f"n {len(told)}"),
    ]  # fmt: skip


def meet(seed: int) -> dict[str, object]:
    """Stage the meeting of a seed; return its figures as JSON can hold them."""
    return asdict(StagedMeeting(seed).run())


class StagedMeeting:
    """Hold one meeting while it goes on."""

    def __init__(self, seed: int) -> None:
        """Put robot and person at their ends of the hallway."""
        random = Random(f"meeting {seed}")
        self.east = random.random() < 0.5
        goals, robot_m, person_m, beyond_m = EAST if self.east else WEST
        at = Pose2(random.uniform(*robot_m), MIDDLE_M, 0.0 if self.east else 3.14)
        begins = (random.uniform(*person_m), MIDDLE_M + random.uniform(-ASIDE_M, ASIDE_M))
        # They walk to the robot's end of the hallway, and back again.
        ends = (random.uniform(*beyond_m), MIDDLE_M + random.uniform(-ASIDE_M, ASIDE_M))
        robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
        self.world = LockstepWorld(site=SITE, seed=seed + 1, robot=robot, start=at)
        speed_mps = random.uniform(0.5, 1.0)
        self.person = Walker(
            self.world, "person_0", begins, [ends, begins], speed_mps, Manner.POLITE
        )
        self.goal = self.world.say(f"go to the {random.choice(goals)}")

    def run(self) -> Meeting:
        """Let them meet; end once the goal has, and they are past each other or never will be."""
        world, meeting = self.world, Meeting()
        began_s, met_s, touched = world.now_s, 0.0, world.contacts
        while world.now_s < began_s + LIMIT_S:
            if not self.goal.has_ended:
                meeting.took_s = world.now_s - began_s
            elif not meeting.met or meeting.solved_s is not None:
                break
            world.tick()
            self.person.turn()
            if not meeting.met and self.person.gap_m <= MET_M:
                meeting.met, met_s = True, world.now_s
            if meeting.met and meeting.solved_s is None and self.is_solved():
                meeting.solved_s = world.now_s - met_s
        meeting.reached = self.goal.state is GoalState.SUCCEEDED
        meeting.contacts = world.contacts - touched
        plan = self.goal.record.plan
        steps = plan.steps if plan is not None else ()
        meeting.recoveries = tuple(name for step in steps for name in step.recoveries)
        return meeting

    def is_solved(self) -> bool:
        """Tell whether each is on the other's far side, or the robot where it was to go."""
        ahead_m = self.world.truth.x_m - self.person.x_m
        past_m = ahead_m if self.east else -ahead_m
        return past_m >= APART_M or self.goal.state is GoalState.SUCCEEDED
