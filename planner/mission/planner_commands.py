"""Carry out what a person says to the planner itself, before any brain, on every turn.

Stands before the brain as one that thinks: the goal is journalled as any other and ends at once.
Only a person's own words are looked at, never what a model wrote.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Protocol

from planner.language import commands
from planner.language.catalogue import join, message, say
from planner.language.plan_words import tell_steps
from planner.language.readers import BY_THE_PLANNER, readings
from planner.language.reading import CommandReading, OrdersReading
from planner.language.schedule import ChangeOrders, OrderCommand
from planner.language.sentence import SaidSentence, parse
from planner.mission import events
from planner.mission.agents import MAY_ASK, NEEDED, hold_to_agent, is_agents
from planner.mission.effects import AskBrain
from planner.mission.events import Command, Planned, Submitted
from planner.mission.follow_up import last_orders
from planner.mission.memory_lookup import SPOKEN_BY, FactCommands, GoalBook, MemoryLookup
from planner.mission.plan_roles import goals_to_end
from planner.mission.reception import goal_to_pause, goal_to_resume
from planner.mission.spoken_status import doing, tell_battery, tell_outcome, tell_position
from planner.mission.standing_goals import OrderDesk, hold_to_order, is_of_order, take_back_offers
from planner.plan import AnswerPlan, Bilingual, Code, Refuse, Say, StepPlan, steps_of
from planner.site import PlaceRefusal
from planner.site.known_places import KnownPlaces, Lesson
from planner.site.places import Place, normalise
from planner.site.pose_hint import hint_in
from planner.skill_files.problems import SkillProblem

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from planner.mission.state import Mission, MissionState
    from planner.mission.tasks import Think
    from planner.skill_files.keep import SkillKeeper
    from wire import HintVerdict, PoseHint


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
        self.fact_commands = FactCommands(lookup, memory, loop)
        self.desk: OrderDesk | None = None
        """Who keeps the standing orders."""
        self.skills: SkillKeeper | None = None
        """Who keeps an order's steps as a skill."""

    async def think(self, ask: AskBrain) -> Planned:
        """Answer at once where the planner itself is meant."""
        mission = self._loop.book.missions.get(ask.id)
        if mission is None:
            return take_back_offers(await self._brain(ask), self.refuse_offer)
        if self.desk is not None and is_of_order(mission):
            return await self._think_of_order(self.desk, ask, mission)
        is_newest = ask.text == mission.words  # and not a model's question
        said, words = parse(ask.own_words if is_newest else ""), _WordsOf(self, mission)
        by_agent = is_agents(mission.source)
        found: Iterator[OrdersReading | CommandReading] = readings(said, words, BY_THE_PLANNER)
        for reading in found:
            if by_agent and not (
                isinstance(reading, CommandReading) and isinstance(reading.intent, MAY_ASK)
            ):
                return Planned(ask.id, NEEDED)  # it is a person's to say to the planner
            if (taken := await self._take(reading, ask, mission)) is not None:
                return taken
        planned = take_back_offers(await self._brain(ask), self.refuse_offer)
        return hold_to_agent(planned) if by_agent else planned

    async def _take(
        self, reading: OrdersReading | CommandReading, ask: AskBrain, mission: Mission
    ) -> Planned | None:
        """Do what was read; None where it turns out to be about something else."""
        if isinstance(reading, OrdersReading):
            own = replace(ask, text=ask.own_words)
            return (
                None if self.desk is None else await self.desk.take(reading.command, own, mission)
            )
        if isinstance(reading.intent, commands.Replace):
            rest = reading.intent.rest
            return await self._brain(replace(ask, text=rest, order="", exchanges=()))
        if mission.steps:
            return None
        return Planned(ask.id, await self.carry_out(reading.intent, mission))

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

    async def obey_beside_stop(self, given: Submitted) -> Bilingual | None:
        """Remove or pause the standing orders that an order to stop names, too; say which.

        "Stop checking the door every evening" stops the robot first, and then means what it says.
        """
        command = parse(given.text).intent
        if is_agents(given.source) or not isinstance(command, ChangeOrders):
            return None  # an agent's stop stops, and that is all
        if self.desk is None or not given.stop:
            return None  # a doubtful stop is thought about, and carried out then
        return await self.desk.change(command, given.language)

    @property
    def book(self) -> MissionState:
        """Return where everything stands."""
        return self._loop.book

    async def carry_out(self, intent: commands.Intent, mission: Mission) -> AnswerPlan | Refuse:
        """Do it and say how it went."""
        book = self._loop.book
        match intent:
            case commands.Remember() | commands.Forget() | commands.KeepSkill():
                return await self._learn(intent, mission)
            case commands.TeachFact() | commands.ForgetFacts():
                return await self.fact_commands.carry_out(intent)
            case commands.HereCommand(name):
                return await self._hint(name)
            case commands.PauseCommand():
                return self._command_goal("pause", events.Pause, goal_to_pause(book, mission.id))
            case commands.CancelCommand():
                return self._command_goal("cancel", events.Cancel, *goals_to_end(book, mission))
            case commands.ResumeCommand():
                return self._command_goal("resume", events.Resume, goal_to_resume(book, mission.id))
            case commands.Doing():
                return AnswerPlan(text=doing(book, self._loop.status_age_s, mission.id))
            case commands.OutcomeCommand():
                told = tell_outcome(book, mission.id)
                return AnswerPlan(text=told or doing(book, self._loop.status_age_s, mission.id))
            case commands.BatteryCommand():
                return AnswerPlan(text=tell_battery(book, self._loop.status_age_s))
            case commands.Slower() | commands.Faster():
                return self._change_speed(slower=isinstance(intent, commands.Slower))
            case _:  # where it is; nothing else comes here
                return AnswerPlan(text=tell_position(book, self._loop.status_age_s))

    def _command_goal(
        self, what: str, make: Callable[[str], Command], *goals: str | None
    ) -> AnswerPlan:
        """Give a command about goals and tell its result."""
        done, nothing = _SAID[what]
        told = []
        for goal_id in filter(None, goals):
            text = self._loop.book.missions[goal_id].text[:60]
            error = self._loop.obey(make(goal_id))
            told.append(error.message if error else say("commands.done", done=done, text=text))
        return AnswerPlan(text=join(told) if told else nothing)

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

    def place_called(self, name: str) -> Place | None:
        """Return the place that answers to a name, as people write it."""
        wanted = normalise(name)
        places = self._memory.places
        return next((p for p in places if wanted in map(normalise, p.spoken_names)), None)

    async def _hint(self, name: str) -> AnswerPlan | Refuse:
        """Tell localization where a person says the robot is, and say what scans make of it."""
        if self._memory.facts.grows:  # the mapper takes no hints: nobody would answer
            return _refuse(Code.HINT_REFUSED, say("hint.map_grows"))
        place = self.place_called(name)
        if place is None or self._link.localizer is None:
            return _refuse(Code.HINT_REFUSED, say("hint.no_localizer"))
        verdict = await self._link.hint(hint_in(place))
        if verdict is None or verdict.code != "accepted":
            code = "no_answer" if verdict is None else verdict.code
            return _refuse(Code.HINT_REFUSED, say(f"hint.{code}"))
        return AnswerPlan(text=say("hint.accepted"))

    async def _learn(
        self, intent: commands.Remember | commands.Forget | commands.KeepSkill, mission: Mission
    ) -> AnswerPlan | Refuse:
        """Keep a place or a skill under a name, or forget a place."""
        match intent:
            case commands.Remember(name):
                return await self._remember(name)
            case commands.Forget(name):
                return await self._forget(name)
            case commands.KeepSkill(name):
                return await self._keep_skill(name, mission)

    async def _remember(self, name: str) -> AnswerPlan | Refuse:
        try:
            place, new = await self._memory.teach(Lesson(en=name, by=SPOKEN_BY))
        except PlaceRefusal as refused:
            return _refuse(Code.PLACE_NOT_KEPT, refused.why)
        names = Bilingual(en=place.name.en, zh=place.name.zh)
        if new:
            return AnswerPlan(text=say("commands.remembered", names=names))
        return AnswerPlan(text=say("commands.place_moved", names=names))

    async def _keep_skill(self, name: str, mission: Mission) -> AnswerPlan | Refuse:
        """Keep what the order before was planned as; what a skill of it did, too."""
        before = last_orders(self._loop.book, mission.created_unix_s)
        steps = next((steps_of(m.steps) for m in before if m.steps and m.id != mission.id), ())
        if not steps or self.skills is None:
            return _refuse(Code.SKILL_NOT_KEPT, say("skill.skill_nothing_before"))
        try:
            skill = await self.skills.keep(name, steps)
        except SkillProblem as problem:
            return _refuse(Code.SKILL_NOT_KEPT, problem.said)
        told = tell_steps(steps, self._memory.vocabulary.name)
        return AnswerPlan(text=say("skill.kept", name=name, steps=told, file=skill.file))

    async def _forget(self, name: str) -> AnswerPlan | Refuse:
        try:
            place = await self._memory.forget(name)
        except PlaceRefusal as refused:
            return _refuse(Code.PLACE_NOT_KEPT, refused.why)
        return AnswerPlan(
            text=say("commands.forgotten", name=Bilingual(en=place.name.en, zh=place.name.zh))
        )


_NOTHING_RUNS = say("commands.nothing_runs")
_SAID: dict[str, tuple[Bilingual, Bilingual]] = {
    "pause": (say("commands.paused"), say("commands.nothing_to_pause")),
    "resume": (say("commands.resumed"), say("commands.nothing_to_resume")),
    "cancel": (say("commands.cancelled"), say("commands.nothing_to_cancel")),
}
"""What is said when it was done, and when there was nothing to do it to."""


def _refuse(code: Code, why: Bilingual) -> Refuse:
    return Refuse(code=code, reason=message(code, why=why))


class _WordsOf:
    """Say what the planner knows of a goal whose words are read."""

    def __init__(self, planner: PlannerCommands, mission: Mission) -> None:
        self._planner, self._mission = planner, mission
        self._is_first = not (mission.replies or mission.steps)

    @property
    def open_order(self) -> OrderCommand | None:
        asked = None if self._mission.has_begun else parse(self._mission.order_text).intent
        return asked if isinstance(asked, OrderCommand) else None

    def correct_fact(self, said: SaidSentence) -> commands.TeachFact | None:
        facts, mission = self._planner.fact_commands, self._mission
        return facts.read_correction(mission, said.intent) if self._is_first else None

    def tell_fact(self, said: SaidSentence) -> commands.TeachFact | None:
        asked = not self._is_first or self._planner.fact_commands.answers_question(self._mission)
        return None if asked else said.statement

    def is_place(self, name: str) -> bool:
        return self._planner.place_called(name) is not None

    @property
    def has_outcome(self) -> bool:
        return tell_outcome(self._planner.book, self._mission.id) is not None
