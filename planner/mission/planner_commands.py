"""Carry out what a person says to the planner itself, before any brain, on every turn.

Stands before the brain as one that thinks: the goal is journalled as any other and ends at once.
Only a person's own words are looked at, never what a model wrote.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import message, say
from planner.language.commands import (
    BatteryCommand,
    CancelCommand,
    Doing,
    Faster,
    Forget,
    ForgetFacts,
    HereCommand,
    Intent,
    OutcomeCommand,
    PauseCommand,
    Remember,
    Replace,
    ResumeCommand,
    Slower,
    TeachFact,
    read_statement,
)
from planner.language.schedule import ChangeOrders, OrderCommand
from planner.language.utterance import parse
from planner.mission import events
from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.mission.fact_commands import FactCommands
from planner.mission.reception import goal_to_pause, goal_to_resume
from planner.mission.spoken_status import doing, tell_battery, tell_outcome, tell_position
from planner.mission.standing_goals import hold_to_order, is_of_order, take_back_offers
from planner.mission.state import goal_to_end
from planner.plan import AnswerPlan, Bilingual, Code, Refuse, Say, StepPlan
from planner.site import PlaceRefusal
from planner.site.known_places import Lesson
from planner.site.places import normalise
from planner.site.pose_hint import hint_in

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.mission.events import Command, Submitted
    from planner.mission.goal_book import GoalBook
    from planner.mission.memory_lookup import MemoryLookup
    from planner.mission.standing_goals import OrderDesk
    from planner.mission.state import Mission
    from planner.mission.tasks import Think
    from planner.site.known_places import KnownPlaces
    from planner.site.places import Place
    from wire import HintVerdict, PoseHint

SPOKEN_BY = "sentence"


class HintLink(Protocol):
    """Reach the localizer, as the link does."""

    @property
    def localizer(self) -> object | None: ...

    async def hint(self, hint: PoseHint) -> HintVerdict | None:
        """Bring a person's word; return the verdict, or None where none came in time."""


class PlannerCommands:
    """Think about what the planner itself is told; hand everything else to the brain."""

    def __init__(
        self,
        think: Think,
        memory: KnownPlaces,
        loop: GoalBook,
        link: HintLink,
        lookup: MemoryLookup | None = None,
    ) -> None:
        """Take what it needs of the missions.

        Args:
            think: how the brain thinks about all other sentences.
            memory: the places.
            loop: where everything stands now, and who obeys commands.
            link: brings localization a person's word on where the robot is.
            lookup: what was seen and told.
        """
        self._brain, self._memory, self._loop, self._link = think, memory, loop, link
        self._facts = FactCommands(lookup, memory, loop)
        self.desk: OrderDesk | None = None
        """Who keeps the standing orders."""

    async def think(self, ask: AskBrain) -> Planned:
        """Answer at once where the planner itself is meant."""
        mission = self._loop.book.missions.get(ask.id)
        if self.desk is not None and mission is not None and is_of_order(mission):
            return await self._think_of_order(self.desk, ask, mission)
        intent = (
            parse(ask.own_words).intent
            if mission is not None and _by_person(mission, ask)
            else None
        )
        if mission is not None and (taken := await self._ask_desk(intent, ask, mission)):
            return taken
        if isinstance(intent, OrderCommand):
            intent = None
        if mission is not None and not (mission.replies or mission.steps):
            intent = self._facts.read_correction(mission.text, mission, intent) or intent
        if isinstance(intent, Replace):
            return await self._brain(replace(ask, text=intent.rest, order="", exchanges=()))
        if isinstance(intent, HereCommand) and self._place(intent.name) is None:
            intent = None  # "you are in the way": nothing of ours
        if isinstance(intent, OutcomeCommand) and tell_outcome(self._loop.book, ask.id) is None:
            intent = None  # nothing was done before: a brain reads "how many?"
        if isinstance(intent, ForgetFacts) and self._place(intent.about) is not None:
            intent = None  # "forget about the kitchen": a drive may be meant
        if intent is None and mission is not None and not (mission.replies or mission.steps):
            intent = (
                None if self._facts.answers_question(mission) else read_statement(ask.own_words)
            )
        if intent is None or mission is None or mission.steps:
            return take_back_offers(await self._brain(ask), self.refuse_offer)
        return Planned(ask.id, await self.carry_out(intent, mission))

    async def _think_of_order(self, desk: OrderDesk, ask: AskBrain, mission: Mission) -> Planned:
        """Plan the goal of a standing order; a reminder's words are fixed, and no brain's."""
        sentence, reminder = desk.sentence_of(mission.source)
        if reminder and not mission.steps:
            return Planned(ask.id, StepPlan(steps=(Say(text=reminder),)))
        planned = await self._brain(replace(ask, standing=sentence))
        return hold_to_order(planned, desk.allowed_steps(mission.source))

    def refuse_offer(self, text: str) -> Bilingual | None:
        """Return why a standing order that a brain offers could not be kept; None: it could."""
        return self.desk.refuse_offer(text) if self.desk is not None else None

    async def _ask_desk(
        self, intent: Intent | None, ask: AskBrain, mission: Mission
    ) -> Planned | None:
        """Have the desk take what is about standing orders; None: it is about something else."""
        standing = intent
        if not mission.has_begun and not isinstance(intent, OrderCommand):
            standing = parse(mission.order_text).intent  # its question is answered
        if self.desk is None or not isinstance(standing, OrderCommand):
            return None
        return await self.desk.take(standing, replace(ask, text=ask.own_words), mission)

    async def obey_beside_stop(self, given: Submitted) -> Bilingual | None:
        """Remove or pause the standing orders that an order to stop names, too; say which.

        "Stop checking the door every evening" stops the robot first, and then means what it says.
        """
        command = parse(given.text).intent
        if self.desk is None or not given.stop or not isinstance(command, ChangeOrders):
            return None  # a doubtful stop is thought about, and carried out then
        return await self.desk.change(command, given.language)

    async def carry_out(self, intent: Intent, mission: Mission) -> AnswerPlan | Refuse:
        """Do it and say how it went."""
        book = self._loop.book
        match intent:
            case Remember(name):
                return await self._remember(name)
            case Forget(name):
                return await self._forget(name)
            case TeachFact() | ForgetFacts():
                return await self._facts.carry_out(intent)
            case HereCommand(name):
                return await self._hint(name)
            case PauseCommand():
                return self._command_goal("pause", events.Pause, goal_to_pause(book, mission.id))
            case CancelCommand():
                own = mission.id if mission.replies else None
                found = goal_to_end(book, mission.id)
                return self._command_goal("cancel", events.Cancel, found or own)
            case ResumeCommand():
                return self._command_goal("resume", events.Resume, goal_to_resume(book, mission.id))
            case Doing():
                return AnswerPlan(text=doing(book, self._loop.status_age_s, mission.id))
            case OutcomeCommand():
                told = tell_outcome(book, mission.id)
                return AnswerPlan(text=told or doing(book, self._loop.status_age_s, mission.id))
            case BatteryCommand():
                return AnswerPlan(text=tell_battery(book, self._loop.status_age_s))
            case Slower() | Faster():
                return self._change_speed(slower=isinstance(intent, Slower))
            case _:  # where it is; nothing else comes here
                return AnswerPlan(text=tell_position(book, self._loop.status_age_s))

    def _command_goal(
        self, what: str, make: Callable[[str], Command], goal_id: str | None
    ) -> AnswerPlan:
        """Give a command about a goal and tell its result."""
        done, nothing = _SAID[what]
        if goal_id is None:
            return AnswerPlan(text=nothing)
        text = self._loop.book.missions[goal_id].text[:60]
        error = self._loop.obey(make(goal_id))
        if error is not None:
            return AnswerPlan(text=error.message)
        return AnswerPlan(text=say("commands.done", done=done, text=text))

    def _change_speed(self, *, slower: bool) -> AnswerPlan:
        """Change the speed cap of the running goal and tell the new one."""
        running = self._loop.book.running
        if running is None:
            return AnswerPlan(text=_NOTHING_RUNS)
        error = self._loop.obey(events.ChangeSpeed(running, slower=slower))
        if error is not None:
            return AnswerPlan(text=error.message)
        mission = self._loop.book.missions[running]
        share, text = f"{100.0 * mission.speed_share:.0f} %", mission.text[:60]
        if mission.speed_share == 1.0:
            return AnswerPlan(text=say("commands.full_speed", text=text))
        return AnswerPlan(text=say("commands.speed_cap", share=share, text=text))

    def _place(self, name: str) -> Place | None:
        """Return the place that answers to a name, as people write it."""
        wanted = normalise(name)
        places = self._memory.places
        return next((p for p in places if wanted in map(normalise, p.spoken_names)), None)

    async def _hint(self, name: str) -> AnswerPlan | Refuse:
        """Tell localization where a person says the robot is, and say what scans make of it."""
        if self._memory.facts.grows:  # the mapper takes no hints: nobody would answer
            return _hint_refused("map_grows")
        place = self._place(name)
        if place is None or self._link.localizer is None:
            return _hint_refused("no_localizer")
        verdict = await self._link.hint(hint_in(place))
        if verdict is None or verdict.code != "accepted":
            return _hint_refused("no_answer" if verdict is None else verdict.code)
        return AnswerPlan(text=say("hint.accepted"))

    async def _remember(self, name: str) -> AnswerPlan | Refuse:
        try:
            place, new = await self._memory.teach(Lesson(en=name, by=SPOKEN_BY))
        except PlaceRefusal as refused:
            return not_kept(refused)
        names = Bilingual(en=place.name.en, zh=place.name.zh)
        if new:
            return AnswerPlan(text=say("commands.remembered", names=names))
        return AnswerPlan(text=say("commands.place_moved", names=names))

    async def _forget(self, name: str) -> AnswerPlan | Refuse:
        try:
            place = await self._memory.forget(name)
        except PlaceRefusal as refused:
            return not_kept(refused)
        return AnswerPlan(
            text=say("commands.forgotten", name=Bilingual(en=place.name.en, zh=place.name.zh))
        )


_NOTHING_RUNS = say("commands.nothing_runs")
_SAID: dict[str, tuple[Bilingual, Bilingual]] = {
    "pause": (
        say("commands.paused"),
        say("commands.nothing_to_pause"),
    ),
    "resume": (
        say("commands.resumed"),
        say("commands.nothing_to_resume"),
    ),
    "cancel": (
        say("commands.cancelled"),
        say("commands.nothing_to_cancel"),
    ),
}
"""What is said when it was done, and when there was nothing to do it to."""


def not_kept(refused: PlaceRefusal) -> Refuse:
    """Say why a place was not kept or not forgotten."""
    why = refused.why
    return Refuse(code=Code.PLACE_NOT_KEPT, reason=message(Code.PLACE_NOT_KEPT, why=why))


def _hint_refused(code: str) -> Refuse:
    """Say why a person's word on where the robot is changed nothing."""
    return Refuse(
        code=Code.HINT_REFUSED, reason=message(Code.HINT_REFUSED, why=say(f"hint.{code}"))
    )


def _by_person(mission: Mission, ask: AskBrain) -> bool:
    """Tell whether the words are the person's own newest ones, not a model's question."""
    return ask.text == mission.words
