"""Say what the routes need of missions, robot, site and ears: small protocols, so that tests can
stand behind them and the routes know no zenoh and no journal.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Mapping, Sequence

    from planner.brain import Brain
    from planner.brain.model_replies import ReplyCollector
    from planner.budget import Usage
    from planner.memory import Recollection
    from planner.mission import Leg
    from planner.mission.goal_history import GoalHistory
    from planner.navigation import ObstacleReport
    from planner.orders.factory import StandingOrders
    from planner.people import People
    from planner.perception import Picture, Sight, Thing
    from planner.plan import Goal, Language, Means, Step
    from planner.rehearsal import Rehearser
    from planner.rehearsal_drive import RehearsalDrives
    from planner.settings_desk import SettingsDesk
    from planner.setup_wizard import SetupWizard
    from planner.site import FenceProposals, KnownPlaces, Site
    from planner.skill_files.folder import SkillFolder
    from planner.tool_servers import ToolDesk
    from planner.voice import Recogniser, SpeechSink, VoiceAbilities
    from planner.watching import PlannerFigures
    from wire import (
        Answer,
        FenceRequest,
        HintVerdict,
        LocalizerStatus,
        MarksRequest,
        OpKind,
        OpRequest,
        PoseHint,
        RobotDescription,
        Status,
        TrialOrder,
        TrialState,
    )


class StopConfirmation(Protocol):
    """Say whether the bridge has confirmed a stop."""

    @property
    def is_echoed(self) -> bool: ...


class LayerSource(Protocol):
    """Hold what the obstacle layer held after the newest scan."""

    @property
    def report(self) -> ObstacleReport | None: ...


class StepIntake(Protocol):
    """Take goals by points of the map and by other steps."""

    async def give(
        self,
        steps: tuple[Step, ...],
        *,
        language: Language,
        confirm: bool = False,
        replace: bool = False,
        idempotency_key: str | None = None,
        act: OpRequest | None = None,
        source: str = "api",
        by: str = "api",
    ) -> str:
        """Take a goal in and return its id; raises MissionError with a stable code."""
        ...


class Goals(Protocol):
    """Keep goals; each method answers at once and raises MissionError with a stable code.

    ``act`` is a person's signed ``op/resume``, which clears what the bridge holds; ``by`` is the
    door that their words came through, to be shown.
    """

    async def submit(
        self,
        text: str,
        *,
        language: Language | None = None,
        confirm: bool = False,
        replace: bool = False,
        idempotency_key: str | None = None,
        act: OpRequest | None = None,
        source: str = "api",
        by: str = "api",
    ) -> Goal: ...

    @property
    def means(self) -> Means: ...

    @property
    def obstacles(self) -> LayerSource | None: ...

    @property
    def points(self) -> StepIntake: ...

    def hears_stop(self, text: str) -> bool:
        """Return whether these words would stop the robot now, with any other meaning besides."""
        ...

    def awaits_answer(self) -> bool:
        """Return whether a question waits for a yes or no."""
        ...

    def goal(self, goal_id: str) -> Goal: ...

    def goals(self, limit: int = 50) -> Sequence[Goal]: ...

    async def cancel(self, goal_id: str, *, source: str = "api") -> Goal: ...

    async def pause(self, goal_id: str) -> Goal: ...

    async def resume(self, goal_id: str | None = None, *, act: OpRequest | None = None) -> Goal: ...

    async def confirm(
        self, goal_id: str, *, act: OpRequest | None = None, by: str = "api"
    ) -> Goal: ...

    async def answer(
        self, goal_id: str, text: str, *, act: OpRequest | None = None, by: str = "api",
        source: str = "api",
    ) -> Goal: ...  # fmt: skip

    async def move(self, goal_id: str, before: str | None = None) -> Goal: ...

    async def stop(self, source: str) -> StopConfirmation: ...

    def path(self) -> Leg | None: ...

    def subscribe(self) -> AsyncIterator[tuple[int, dict[str, Any]]]: ...


class Robot(Protocol):
    """Hear the bridge and bring it an operator's requests."""

    @property
    def status(self) -> Status | None: ...

    @property
    def description(self) -> RobotDescription: ...

    @property
    def max_speed_mps(self) -> float: ...

    def obstacles(self) -> Sequence[tuple[float, float]]: ...

    @property
    def localizer(self) -> LocalizerStatus | None: ...

    @property
    def takes_hints(self) -> bool: ...

    @property
    def localized_map(self) -> str | None: ...

    async def hint(self, hint: PoseHint) -> HintVerdict | None: ...

    @property
    def trial(self) -> TrialState | None: ...

    async def order_trial(self, order: TrialOrder) -> bool: ...

    def ages_s(self) -> dict[str, float | None]: ...

    async def ask(self, kind: OpKind, request: OpRequest) -> Answer | None: ...

    async def offer_fence(self, request: FenceRequest) -> Answer | None: ...

    async def offer_marks(self, request: MarksRequest) -> Answer | None: ...

    @property
    def driver(self) -> dict[str, str] | None: ...

    def steer(
        self, source: str, v_mps: float, w_radps: float, *, dead_man: bool, name: str = ""
    ) -> None: ...


class Budget(Protocol):
    """Show the model's cost; ``changes`` rises with every change."""

    @property
    def changes(self) -> int: ...

    async def look(self, goal: str | None = None) -> None: ...

    def usage(self, goal: str | None = None) -> Usage: ...


class PerceptionView(Protocol):
    """Show the sight and the remembered things; ``version`` rises when a thing comes or goes."""

    @property
    def sight(self) -> Sight: ...

    @property
    def version(self) -> int: ...

    @property
    def changed_s(self) -> Mapping[str, float]:
        """Return when each thing was last seen or doubted, on ``now_s``'s clock."""

    @property
    def now_s(self) -> float: ...

    @property
    def classes(self) -> tuple[str, ...]: ...

    @property
    def counts(self) -> Mapping[str, int]: ...

    @property
    def skip_counts(self) -> Mapping[str, int]: ...

    @property
    def lag_s(self) -> float: ...

    @property
    def took_s(self) -> float: ...

    async def show(self) -> Picture | None: ...

    def forget(self, thing_id: str | None = None) -> tuple[Thing, ...]: ...


class SetupSwitch(Protocol):
    """Leave the robot to set-up, where who started this planner can start that."""

    @property
    def is_there(self) -> bool: ...

    def throw(self) -> None: ...


class Services(Protocol):
    """Hold the parts of one planner."""

    @property
    def setup(self) -> SetupSwitch: ...

    @property
    def restart(self) -> SetupSwitch: ...

    @property
    def take_robot(self) -> SetupSwitch: ...

    @property
    def change_map(self) -> SetupSwitch: ...

    @property
    def wizard(self) -> SetupWizard: ...

    @property
    def settings_desk(self) -> SettingsDesk: ...

    @property
    def goals(self) -> Goals: ...

    @property
    def rehearser(self) -> Rehearser: ...

    @property
    def rehearsal_drives(self) -> RehearsalDrives: ...

    @property
    def robot(self) -> Robot: ...

    @property
    def site(self) -> Site: ...

    @property
    def memory(self) -> KnownPlaces: ...

    @property
    def fences(self) -> FenceProposals: ...

    @property
    def brain(self) -> Brain: ...

    @property
    def replies(self) -> ReplyCollector: ...

    @property
    def budget(self) -> Budget: ...

    @property
    def figures(self) -> PlannerFigures: ...

    @property
    def history(self) -> GoalHistory: ...

    @property
    def orders(self) -> StandingOrders: ...

    @property
    def ears(self) -> Recogniser: ...

    @property
    def speaker(self) -> SpeechSink: ...

    @property
    def voice(self) -> VoiceAbilities: ...

    @property
    def eyes(self) -> PerceptionView: ...

    @property
    def recollection(self) -> Recollection: ...

    @property
    def people(self) -> People: ...

    @property
    def skills(self) -> SkillFolder: ...

    @property
    def tools(self) -> ToolDesk: ...
