"""Stand behind the standing orders: clocks that a test moves, and missions that remember."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo

from planner.brain import OfflineBrain
from planner.mission.effects import AskBrain
from planner.mission.errors import MissionError
from planner.mission.events import Planned
from planner.mission.plan_request import thinker
from planner.mission.standing_goals import StandingGoals
from planner.mission.state import Mission, MissionState
from planner.orders.factory import StandingOrders
from planner.orders.intake import OrderIntake
from planner.orders.interfaces import OrderClocks
from planner.orders.keeper import OrderKeeper
from planner.orders.new_order import order_of_text
from planner.orders.notifier import Notifier
from planner.orders.order import StandingOrder
from planner.orders.store import OrderStore
from planner.perception.snapshot import Sight
from planner.plan import (
    Code,
    GoalState,
    Language,
    Means,
    Outcome,
    QuietHours,
    Step,
    StepPlan,
    say_same,
)
from planner.site import Site
from planner.site.site_view import facts_of, vocabulary_of
from planner.skills.perception import Eyesight
from planner.state_database import StateDatabase
from tests.wire.examples import STATUS
from wire import CameraConfig, Mode, Status

ROOT = Path(__file__).resolve().parents[3]
BERLIN = ZoneInfo("Europe/Berlin")
NOON_UNIX_S = 1_800_010_800.0
"""2027-01-15, 12:00 in Berlin, a Friday."""
READY = STATUS.model_copy(update={"mode": Mode.HOLD, "held": None, "rows": ()})


@cache
def site_of(name: str) -> Site:
    """Read a site once: it is frozen, and hundreds of tests begin with it."""
    return Site.load(ROOT / "sites" / name)


@dataclass
class MovedClocks:
    """Be all clocks, moved by hand."""

    unix_s: float = NOON_UNIX_S
    monotonic_s: float = 5000.0
    suspended_s: float = 0.0
    """For so long the machine slept: elapsed time went on, monotonic time stood."""
    numbers: Any = field(default_factory=lambda: count(1))

    def pass_s(self, seconds: float) -> None:
        self.unix_s += seconds
        self.monotonic_s += seconds

    def suspend(self, seconds: float) -> None:
        self.unix_s += seconds
        self.suspended_s += seconds

    def clocks(self) -> OrderClocks:
        return OrderClocks(
            lambda: self.monotonic_s,
            lambda: self.unix_s,
            lambda: f"goal-{next(self.numbers)}",
            lambda: self.monotonic_s + self.suspended_s,
        )


class FakeMissions:
    """Think with the offline brain; keep each goal that is given, and end it when told."""

    def __init__(self, clock: MovedClocks, site: str = "home") -> None:
        self.clock, self.site = clock, site_of(site)
        facts, eyes = facts_of(self.site), Eyesight(CameraConfig(), ("person", "cup"))
        self._book = MissionState(facts, status=READY, eyes=eyes, sight=Sight())
        self._shown = self._book, self._book
        self.given: list[tuple[str, str, str, str]] = []
        self.keys: dict[str, str] = {}
        self.published: list[dict[str, Any]] = []
        self.cancelled: list[str] = []
        self.refusal: MissionError | None = None
        self.silent = False

    @property
    def book(self) -> MissionState:
        """Return the book of this instant, made once: a turn looks at it several times."""
        status_s = self.clock.monotonic_s - (60.0 if self.silent else 0.0)
        of, shown = self._shown
        if of is not self._book or shown.status_s != status_s:
            self._shown = self._book, replace(self._book, status_s=status_s)
        return self._shown[1]

    def say_status(self, **changes: Any) -> Status:
        status = READY.model_copy(update=changes)
        self._book = replace(self._book, status=status)
        return status

    def see(self, sight: Sight) -> None:
        self._book = replace(self._book, sight=sight)

    def publish(self, event: dict[str, Any]) -> None:
        self.published.append(event)

    def told(self) -> list[tuple[str, str]]:
        return [(e["kind"], e["code"]) for e in self.published if e["type"] == "told"]

    def find(self, key: str) -> str | None:
        return self.keys.get(key)

    async def consider(
        self, text: str, language: Language, goal_id: str, standing: str = "",
        deed: StepPlan | None = None,
    ) -> Planned:  # fmt: skip
        means = Means(camera=True, detector=True)
        think = thinker(OfflineBrain(), vocabulary_of(self.site), None, means)
        return await think(AskBrain(goal_id, text, language, order=text))

    async def give(
        self, goal_id: str, text: str, language: Language, key: str, source: str,
        steps: tuple[Step, ...] = (),
    ) -> str:  # fmt: skip
        if self.refusal is not None:
            raise self.refusal
        if key in self.keys:
            return self.keys[key]
        self.keys[key] = goal_id
        self.given.append((goal_id, text, key, source))
        self.put(goal_id, text, GoalState.RUNNING, source)
        return goal_id

    def put(self, goal_id: str, text: str, state: GoalState, source: str = "api") -> None:
        kept = Mission(
            id=goal_id, order=len(self._book.missions), text=text, language=Language.EN,
            state=state, source=source, created_unix_s=self.clock.unix_s,
            updated_unix_s=self.clock.unix_s,
            outcome=Outcome(code=Code.DONE, message=say_same("Done.")),
        )  # fmt: skip
        self._book = replace(self._book, missions={**self._book.missions, goal_id: kept})

    def end(self, goal_id: str, state: GoalState = GoalState.SUCCEEDED) -> None:
        kept = self._book.missions[goal_id]
        ended = kept.model_copy(update={"state": state})
        self._book = replace(self._book, missions={**self._book.missions, goal_id: ended})

    def outcome(self, goal_id: str) -> Mission | None:
        return StandingGoals.outcome(self, goal_id)  # type: ignore[arg-type]  # the book alone

    def waits(self, goal_id: str) -> bool:
        return StandingGoals.waits(self, goal_id)  # type: ignore[arg-type]

    def cancel(self, goal_id: str) -> None:
        self.cancelled.append(goal_id)
        self.end(goal_id, GoalState.CANCELLED)


@dataclass
class Kept:
    """Hold standing orders, their missions and their clocks."""

    orders: StandingOrders
    missions: FakeMissions
    clock: MovedClocks

    async def give(self, text: str) -> StandingOrder:
        return await self.orders.intake.give(order_of_text(text, None, "test"), "thought")

    async def turn(self, seconds: float = 0.1) -> None:
        """Let time pass, tick once and do what follows."""
        self.clock.pass_s(seconds)
        self.orders.keeper.turn()
        await self.orders.keeper.work_off()

    async def run_s(self, seconds: float, step_s: float = 0.5) -> None:
        for _ in range(round(seconds / step_s)):
            await self.turn(step_s)


async def kept_in(
    home: Path,
    clock: MovedClocks | None = None,
    missions: FakeMissions | None = None,
    quiet: QuietHours | None = None,
    notifier: Notifier | None = None,
    database: StateDatabase | None = None,
) -> Kept:
    """Return standing orders of a home folder, taken up, with rounds turned by hand."""
    clock = clock or MovedClocks()
    missions = missions or FakeMissions(clock)
    orders = standing_orders(home, clock, missions, quiet, notifier, database)
    await orders.keeper.start(rounds=False)
    return Kept(orders, missions, clock)


def standing_orders(
    home: Path,
    clock: MovedClocks,
    missions: FakeMissions,
    quiet: QuietHours | None = None,
    notifier: Notifier | None = None,
    database: StateDatabase | None = None,
) -> StandingOrders:
    store = OrderStore(database or StateDatabase(home))
    keeper = OrderKeeper(store, missions, BERLIN, quiet, notifier, clock.clocks())
    return StandingOrders(OrderIntake(keeper, missions), keeper)
