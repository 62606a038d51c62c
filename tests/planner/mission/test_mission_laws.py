"""Hold the reducer's laws against random histories: goals, orders, faults, losses, crashes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from planner.bridge_client.ownership import STAND
from planner.language.catalogue import message
from planner.mission import events
from planner.mission.activity import Driving
from planner.mission.effects import AskRoute, Journal, SayAloud
from planner.mission.reducer import advance, motion_request
from planner.mission.state import Mission, MissionState
from planner.mission.transitions import refusal
from planner.navigation.obstruction import Obstruction
from planner.perception.snapshot import LookSnapshot as LookSeen
from planner.perception.snapshot import Sight, Thing
from planner.plan import (
    Ask,
    Code,
    Count,
    Decide,
    Find,
    Follow,
    GoalState,
    GoTo,
    GoToObject,
    GoToPoint,
    Language,
    Look,
    Outcome,
    Patrol,
    Say,
    StepPlan,
    StepState,
    Turn,
    Wait,
)
from planner.plan import MoveStraight as MoveStep
from planner.skills import Eyesight, ImageAnswer
from tests.laws import at_least
from tests.planner.mission.fakes import FACTS, row, status
from wire import Action, CameraConfig, HeldReason, LegReport, Mode, Pose2, StandingHold, Twist2

IDS = ("g1", "g2", "g3")
ids = st.sampled_from(IDS)
plans = st.lists(
    st.sampled_from(
        [
            GoTo(place="kitchen"),
            GoTo(place="hall"),
            Say(text="hi"),
            Wait(seconds=0.3),
            Turn(angle_rad=4.0),
            MoveStep(distance_m=-1.0),
            Patrol(places=("hall", "kitchen")),
            Ask(question="who?"),
            Decide(question="what now?"),
            Find(object="cup"),
            Count(object="cups", place="hall"),
            Look(question="around?"),
            Follow(object="me"),
            GoToObject(object="red cup"),
            GoToPoint(x=500, y=500),
        ]
    ),
    min_size=1,
    max_size=3,
).map(lambda steps: StepPlan(steps=tuple(steps)))
FAILURE = Outcome(code=Code.BAD_PLAN, message=message(Code.BAD_PLAN, why="x"))


@st.composite
def statuses(draw: st.DrawFn) -> dict[str, Any]:
    """Return what a bridge might say, sense or nonsense."""
    leg = draw(
        st.none()
        | st.builds(
            LegReport,
            mission=ids,
            leg=st.integers(0, 3),
            following=st.booleans(),
            reached=st.booleans(),
            residual_m=st.just(0.0),
            residual_rad=st.just(0.0),
            refusal=st.sampled_from([None, "fence_crossed"]),
        )
    )
    names = draw(st.sets(st.sampled_from(["BUDGET", "STUCK", "OBSTACLE", "POSE_JUMP"]), max_size=1))
    held = draw(st.sampled_from([None, None, None, "h1", "h2"]))
    return {
        "mode": draw(st.sampled_from([Mode.HOLD, Mode.ACTIVE, Mode.HOLD, *Mode])),
        "held": StandingHold(reason=draw(st.sampled_from(HeldReason)), id=held) if held else None,
        "leg": leg,
        "base_in_map": draw(st.sampled_from([Pose2(0, 0, 0), Pose2(4, 0, 0), None])),
        "measured": Twist2(draw(st.sampled_from([0.0, 0.3])), 0.0),
        "rows": tuple(row(n, draw(st.sampled_from([Action.CAP, Action.HOLD2]))) for n in names),
        "blocked": draw(st.booleans()),
        "boot": draw(st.sampled_from(["b1", "b1", "b1", "b2"])),
    }


things = st.lists(
    st.builds(
        Thing,
        id=st.sampled_from(["cup_1", "person_1"]),
        label=st.sampled_from(["cup", "person"]),
        color=st.sampled_from([None, "red"]),
        x_m=st.sampled_from([0.5, 2.0, 4.0]),
        y_m=st.just(0.0),
        z_m=st.just(0.8),
        sigma_m=st.just(0.1),
        confidence=st.sampled_from([0.2, 0.9]),
        seen_s=st.sampled_from([0.0, 1e6]),
        first_s=st.just(0.0),
        sightings=st.sampled_from([1, 5]),
        room=st.sampled_from([None, "hall"]),
    ),
    max_size=2,
).map(tuple)
blind = st.sampled_from([None, None, None, "camera_silent", "no_detector"])

happenings = st.one_of(
    st.tuples(st.just("sight"), things, blind),
    st.tuples(st.just("sight"), things, blind),
    st.tuples(st.just("told"), ids, st.sampled_from([None, (2.0, 0.0, 0.0)])),
    st.tuples(st.just("status"), statuses(), st.booleans()),
    st.tuples(st.just("submit"), ids, st.booleans(), st.booleans()),
    st.tuples(st.just("planned"), ids, plans | st.none()),
    st.tuples(st.just("routed"), st.integers(0, 2), st.sampled_from([None, None, "no_route"])),
    st.tuples(st.just("surveyed"), st.sampled_from([2.0, 3.0]), st.booleans()),
    st.tuples(st.just("doubted"), ids, st.integers(0, 2)),
    st.tuples(st.just("safe"), st.integers(0, 3)),
    st.tuples(
        st.just("command"),
        st.sampled_from([events.Cancel, events.Pause, events.Resume, events.Confirm, events.Move]),
        ids,
    ),
    st.tuples(st.just("reply"), ids),
    st.tuples(st.just("stop")),
    st.tuples(st.just("tick")),
    st.tuples(st.just("crash")),
    st.tuples(st.just("drive"), ids, plans),
    st.tuples(st.just("drive"), ids, plans),
    st.tuples(st.just("follow"), ids, st.sampled_from([2.0, 4.0])),
    st.tuples(st.just("arrive")),
)
histories = st.lists(
    st.tuples(happenings, st.sampled_from([0.0, 0.05, 0.05, 1.0, 7.0])), max_size=60
)


EYES = Eyesight(CameraConfig(), model=True)


class World:
    """Feed a history to the reducer and keep what a judge needs."""

    def __init__(self) -> None:
        self.book, self.now_s, self.seq = MissionState(FACTS, eyes=EYES), 100.0, 0
        self.disk: dict[str, Mission] = {}
        self.disk_queue: tuple[str, ...] = ()
        self.entries: list[Journal] = []
        self.written: dict[tuple[str, int], int] = {}
        self.spoken: list[tuple[str, int]] = []
        self.acted = True
        self.stopped = False

    def event(self, event: events.Event) -> None:
        before = self.book
        self.book, effects = advance(before, event, self.now_s)
        assert (self.book, effects) == advance(before, event, self.now_s), "pure"
        for effect in effects:
            if isinstance(effect, Journal):
                self._journal(effect)
            if isinstance(effect, SayAloud):
                mission = before.missions[effect.id]
                self.spoken.append((effect.id, mission.step))
                assert self.book.safe >= self.written[effect.id, mission.step]
            if isinstance(effect, AskRoute):
                assert self.book.missions[effect.id].state is GoalState.RUNNING
        self.judge()

    def _journal(self, entry: Journal) -> None:
        self.entries.append(entry)
        for mission in entry.missions:
            assert Mission.model_validate_json(mission.model_dump_json()) == mission, "as read"
            here = mission.steps[mission.step : mission.step + 1]
            if mission.state is GoalState.RUNNING and here and here[0].state is StepState.RUNNING:
                self.written.setdefault((mission.id, mission.step), entry.entry)

    def judge(self) -> None:
        book, wanted = self.book, motion_request(self.book)
        running = [m for m in book.missions.values() if m.state is GoalState.RUNNING]
        assert len(running) <= 1
        assert [m.id for m in running] == ([book.running] if book.running else [])
        assert (book.activity is not None) == bool(running)
        queued = {m.id for m in book.missions.values() if m.state is GoalState.QUEUED}
        assert set(book.queue) == queued
        assert len(book.queue) == len(queued)
        assert len(set(self.spoken)) == len(self.spoken), "said at most once"
        if wanted.leg is not None:
            mission = book.missions[wanted.mission or ""]
            assert mission.state is GoalState.RUNNING
            assert book.activity is not None
            assert book.safe >= book.activity.record, "no motion before its beginning is on disk"
            held = book.status.held if book.status is not None else None
            assert held is None or held.id == book.pardoned, "no motion under a standing hold"
            assert self.acted, "no motion after a restart or stop without a person's act"
        for mission in book.missions.values():
            if mission.has_ended:
                assert mission.outcome is not None
                assert all(
                    s.state not in (StepState.RUNNING, StepState.PENDING) for s in mission.steps
                )

    def play(self, what: tuple[Any, ...]) -> None:
        match what:
            case ("status", fields, off_path):
                self.seq += 1
                self.event(events.Seen(status(seq=self.seq, **fields), off_path))
            case ("submit", goal, confirm, replace):
                self.acted = self.acted or goal not in self.book.missions
                self.event(events.Submitted(goal, "x", Language.EN, confirm, replace))
            case ("planned", goal, plan):
                self.event(events.Planned(goal, plan, None if plan else FAILURE))
            case ("routed", back, failure):
                ticket = max(0, self.book.tickets - back)
                for goal in IDS:
                    self.event(events.Routed(goal, ticket, failure))
            case ("surveyed", x_m, opened):
                way = Obstruction((x_m, -0.2), (x_m, 0.2))
                self.event(
                    events.Surveyed(
                        None if opened else way, bool(x_m > 2.5), (way,) if opened else ()
                    )
                )
            case ("doubted", goal, back):
                leg = (
                    max(0, self.book.missions[goal].leg - back) if goal in self.book.missions else 1
                )
                self.event(events.RouteDoubted(goal, leg, (2.0, 0.0)))
            case ("safe", back):
                self.event(events.Journalled(max(0, self.book.written - back)))
            case ("tick",):
                self.event(events.Tick())
            case ("sight", seen, why):
                self.seq += 1
                look = LookSeen(self.seq, self.now_s, None, 320, 240, ())
                self.event(events.Sighted(Sight(look, seen, why)))
            case ("told", goal, at):
                self.event(events.Told(goal, self.book.tickets, ImageAnswer(at=at, failure=None)))
            case _:
                self.act(what)

    def act(self, what: tuple[Any, ...]) -> None:
        match what:
            case ("command", kind, goal):
                self.command(kind(goal))
            case ("reply", goal):
                self.command(events.Reply(goal, "yes"))
            case ("stop",):
                self.acted = False
                self.event(events.Stopped("x"))
                assert motion_request(self.book) == STAND
                assert self.book.running is None
            case ("crash",):
                self.crash()
            case ("drive", goal, plan):  # what a good day looks like, so that laws meet motion
                self.play(("status", {}, False))
                self.play(("submit", goal, False, False))
                for step in (("planned", goal, plan), ("safe", 0), ("routed", 0, None)):
                    self.play(step)
            case ("follow", goal, x_m):
                self.follow(goal, x_m)
            case ("arrive",):
                self.arrive()

    def follow(self, goal: str, x_m: float) -> None:
        """Go after somebody who is in sight, by a leg that is laid anew as they walk."""
        anna = Thing("person_1", "person", None, x_m, 0.0, 0.9, 0.1, 0.9, 1e6, 0.0, 5)
        self.play(("sight", (anna,), None))
        self.play(("drive", goal, StepPlan(steps=(Follow(object="me"),))))
        self.now_s += 1.0
        self.play(("sight", (replace(anna, x_m=x_m + 1.0),), None))
        self.play(("safe", 0))
        self.play(("routed", 0, None))

    def arrive(self) -> None:
        """Let the bridge say that the leg in hand is reached."""
        wanted = motion_request(self.book)
        driven = self.book.activity
        if wanted.mission is None or wanted.leg is None or not isinstance(driven, Driving):
            return
        leg = LegReport(mission=wanted.mission, leg=wanted.leg, following=False, reached=True,
                        residual_m=0.0, residual_rad=0.0, refusal=None)  # fmt: skip
        self.play(("status", {"leg": leg, "base_in_map": driven.act.goal}, False))
        self.play(("safe", 0))
        self.play(("routed", 0, None))

    def command(self, command: events.Command) -> None:
        before = self.book
        refused = refusal(before, command)
        if refused is None and isinstance(command, (events.Resume, events.Confirm, events.Reply)):
            self.acted = True
        self.event(command)
        if refused is not None:
            same = {i: m.state for i, m in before.missions.items()}
            assert {i: m.state for i, m in self.book.missions.items()} == same

    def crash(self) -> None:
        """Lose the process: only entries on disk come back."""
        for entry in self.entries:
            if entry.entry <= self.book.safe:
                self.disk.update({m.id: m for m in entry.missions})
                self.disk_queue = entry.queue
        self.entries, self.written = [], {}
        self.book = MissionState(FACTS, eyes=EYES)
        self.acted = False
        self.event(events.Restarted(tuple(self.disk.values()), self.disk_queue, 0.0))
        assert motion_request(self.book) == STAND


@at_least(150)
@given(histories)
def test_no_history_breaks_a_law(history: list[tuple[tuple[Any, ...], float]]) -> None:
    world = World()
    for what, pause_s in history:
        world.now_s += pause_s
        world.play(what)


def test_histories_hold_legs_after_somebody_who_walks() -> None:
    """Without this the laws above would hold of legs that are never laid."""
    world = World()
    world.play(("follow", "g1", 4.0))
    assert isinstance(leg := world.book.activity, Driving)
    assert (leg.act.watch, leg.leg) == (True, 2)
    assert abs(leg.act.goal.x_m - 3.8) < 0.01, "it was laid anew"
    assert motion_request(world.book).leg == 2
    for order in (("command", events.Pause, "g1"), ("command", events.Resume, "g1"), ("stop",)):
        world.play(order)
        world.play(("sight", (), None))
    world.play(("status", {}, False))
    assert motion_request(world.book) == STAND
