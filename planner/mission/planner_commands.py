"""Carry out what a person says to the planner itself, before any brain, on every turn.

Stands before the brain as one that thinks: the goal is journalled as any other and ends at once.
Only a person's own words are looked at, never what a model wrote.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.commands import (
    Cancel,
    Doing,
    Faster,
    Forget,
    Intent,
    Pause,
    Remember,
    Replace,
    Resume,
    Slower,
    Where,
    intent_of,
)
from planner.mission import events
from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.mission.goal_reference import goal_to_end, goal_to_pause, goal_to_resume
from planner.mission.known_places import Lesson
from planner.mission.spoken_status import doing, where
from planner.plan import Answer, Bilingual, Code, Refuse, message
from planner.site import PlaceRefused

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.mission.errors import MissionError
    from planner.mission.events import Command
    from planner.mission.known_places import KnownPlaces
    from planner.mission.state import Mission, MissionState
    from planner.mission.tasks import Think

SPOKEN_BY = "sentence"


class PlannerCommands:
    """Think about what the planner itself is told; hand everything else to the brain."""

    def __init__(
        self,
        think: Think,
        memory: KnownPlaces,
        book: Callable[[], MissionState],
        command: Callable[[Command], MissionError | None],
        age_s: Callable[[], float],
    ) -> None:
        """Take what it needs of the missions.

        Args:
            think: how the brain thinks about all other sentences.
            memory: the places.
            book: where everything stands now.
            command: obeys a command, or says why it can't be obeyed.
            age_s: how old the newest status is.
        """
        self._brain, self._memory, self._book = think, memory, book
        self._command, self._age_s = command, age_s

    async def think(self, ask: AskBrain) -> Planned:
        """Answer at once where the planner itself is meant."""
        mission = self._book().missions.get(ask.id)
        intent = intent_of(ask.text) if mission is not None and _by_person(mission, ask) else None
        if isinstance(intent, Replace):
            return await self._brain(replace(ask, text=intent.rest, order="", exchanges=()))
        if intent is None or mission is None or mission.steps:
            return await self._brain(ask)
        return Planned(ask.id, await self.carry_out(intent, mission))

    async def carry_out(self, intent: Intent, mission: Mission) -> Answer | Refuse:
        """Do it and say how it went."""
        match intent:
            case Remember(name):
                return await self._remember(name)
            case Forget(name):
                return await self._forget(name)
            case Pause():
                return self._each("pause", events.Pause, goal_to_pause(self._book(), mission.id))
            case Cancel():
                own = mission.id if mission.replies else None
                found = goal_to_end(self._book(), mission.id)
                return self._each("cancel", events.Cancel, found or own)
            case Resume():
                return self._each("resume", events.Resume, goal_to_resume(self._book(), mission.id))
            case Doing():
                return Answer(text=doing(self._book(), self._age_s(), mission.id))
            case Slower() | Faster():
                return self._change_speed(slower=isinstance(intent, Slower))
            case Where() | Replace():
                return Answer(text=where(self._book(), self._age_s()))

    def _each(self, what: str, make: Callable[[str], Command], goal_id: str | None) -> Answer:
        """Give a command about a goal and say what became of it."""
        done, nothing = _SAID[what]
        if goal_id is None:
            return Answer(text=nothing)
        text = self._book().missions[goal_id].text[:60]
        error = self._command(make(goal_id))
        if error is not None:
            return Answer(text=error.message)
        return Answer(text=Bilingual(en=f"{done.en}: “{text}”.", zh=f"{done.zh}：“{text}”。"))

    def _change_speed(self, *, slower: bool) -> Answer:
        """Change the speed cap of the running goal and say what it is now."""
        running = self._book().running
        if running is None:
            return Answer(text=_NOTHING_RUNS)
        error = self._command(events.ChangeSpeed(running, slower=slower))
        if error is not None:
            return Answer(text=error.message)
        mission = self._book().missions[running]
        share, text = f"{100.0 * mission.speed_share:.0f} %", mission.text[:60]
        return Answer(
            text=Bilingual(
                en=f"At most {share} of the planned speed for “{text}” from now on.",
                zh=f"从现在起，“{text}”的速度不超过原计划的 {share}。",
            )
        )

    async def _remember(self, name: str) -> Answer | Refuse:
        try:
            place, new = await self._memory.teach(Lesson(en=name, by=SPOKEN_BY))
        except PlaceRefused as refused:
            return not_kept(refused)
        names = place.name
        if new:
            return Answer(
                text=Bilingual(
                    en=f"I will remember this place as “{names.en}”.",
                    zh=f"我记住了，这里是“{names.zh}”。",
                )
            )
        return Answer(
            text=Bilingual(
                en=f"“{names.en}” is here from now on.", zh=f"以后“{names.zh}”就是这里。"
            )
        )

    async def _forget(self, name: str) -> Answer | Refuse:
        try:
            place = await self._memory.forget(name)
        except PlaceRefused as refused:
            return not_kept(refused)
        return Answer(
            text=Bilingual(
                en=f"I have forgotten “{place.name.en}”.", zh=f"我已忘记“{place.name.zh}”。"
            )
        )


_NOTHING_RUNS = Bilingual(
    en="No goal is running whose speed could change.", zh="没有正在执行的任务，无法改变速度。"
)
_SAID: dict[str, tuple[Bilingual, Bilingual]] = {
    "pause": (
        Bilingual(en="Paused", zh="已暂停"),
        Bilingual(en="There is nothing to pause.", zh="没有可以暂停的任务。"),
    ),
    "resume": (
        Bilingual(en="I go on", zh="继续执行"),
        Bilingual(en="There is nothing to go on with.", zh="没有可以继续的任务。"),
    ),
    "cancel": (
        Bilingual(en="Cancelled", zh="已取消"),
        Bilingual(en="There is nothing to cancel.", zh="没有可以取消的任务。"),
    ),
}
"""What is said when it was done, and when there was nothing to do it to."""


def not_kept(refused: PlaceRefused) -> Refuse:
    """Say why a place was not kept or not forgotten."""
    why = refused.why
    return Refuse(code=Code.PLACE_NOT_KEPT, reason=message(Code.PLACE_NOT_KEPT, why=why))


def _by_person(mission: Mission, ask: AskBrain) -> bool:
    """Tell whether the words are the person's own newest ones, not a model's question."""
    return ask.text == mission.words
