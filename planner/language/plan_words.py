"""Tell steps as an order in words, so that a person knows what a yes would do. Pure.

Law: every step is told but a drive that is only the way to the next one, and what hangs on a
condition is told with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING

from planner.language.catalogue import join, say, say_or_quote
from planner.language.object_names import tell_words
from planner.plan import (
    Ask,
    Attempt,
    Bilingual,
    ClockTime,
    Count,
    Find,
    Follow,
    GoTo,
    GoToObject,
    GoToPose,
    If,
    Look,
    MoveStraight,
    Patrol,
    Recall,
    Repeat,
    Say,
    StandAt,
    Step,
    Turn,
    UseSkill,
    UseTool,
    Wait,
    WaitFor,
)
from planner.plan.steps import MAX_LOOP_S, MAX_ROUNDS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from planner.plan.steps import Condition

_ALONE = {
    "come_back": "order.come_back",
    "return_home": "order.go_home",
    "explore": "order.explore",
}
_ROUND = frozenset({"look around", "看看周围"})
"""Questions of a look that asks for nothing in particular."""


def tell_steps(steps: Sequence[Step], name_of: Callable[[str], Bilingual]) -> Bilingual:
    """Return the order of these steps in both languages.

    Args:
        steps: one or several.
        name_of: returns how a place is called by its id.
    """
    return _Teller(name_of).row(steps)


def _tell_span(seconds: float) -> Bilingual:
    """Return a time in whole minutes where it is so, else in seconds."""
    if seconds >= 60.0 and seconds % 60.0 == 0.0:
        return say("order.minutes", minutes=seconds / 60.0)
    return say("order.seconds", seconds=seconds)


def _is_way(steps: Sequence[Step], at: int) -> bool:
    """Return whether a step is only the way to what is done next at the same place."""
    step, after = steps[at], steps[at + 1] if at + 1 < len(steps) else None
    if isinstance(step, Find):  # who is followed is found first
        return isinstance(after, Follow) and after.object == step.object and not step.place
    if not (isinstance(step, GoTo) and isinstance(after, Find | Count | Look | GoToObject)):
        return False
    return after.place == step.place


@dataclass(frozen=True, slots=True)
class _Teller:
    name_of: Callable[[str], Bilingual]

    def row(self, steps: Sequence[Step]) -> Bilingual:
        kept = [step for at, step in enumerate(steps) if not _is_way(steps, at)]
        return join(map(self.step, kept), "joint.then")

    def step(self, step: Step) -> Bilingual:
        """Return what one step does."""
        match step:
            case GoTo():
                return say("order.go_to", name=self.name_of(step.place))
            case GoToPose():
                code = "order.look_at_point" if step.look else "order.go_to_pose"
                return say(code, x_m=f"{step.x_m:.2f}", y_m=f"{step.y_m:.2f}")
            case StandAt():
                return self._stand(step)
            case Find() | Count() | GoToObject():
                return self._at(f"order.{step.kind}", step.place, object=_with_article(step.object))
            case Look() if step.question in _ROUND:
                return self._at("order.look", step.place)
            case Look():
                return self._at("order.check", step.place, question=step.question)
            case Patrol():
                names = join(map(self.name_of, step.places), "joint.and_the")
                return say("order.inspect" if step.look else "order.patrol", names=names)
            case If() | Attempt() | Repeat():
                return self._holder(step)
            case Recall():
                return self._recall(step)
            case _:
                return _tell_plain(step)

    def _at(self, code: str, place: str | None, **facts: Bilingual | str) -> Bilingual:
        if place is None:
            return say(code, **facts)
        return say(f"{code}_in", place=self.name_of(place), **facts)

    def _stand(self, step: StandAt) -> Bilingual:
        name = self.name_of(step.place) if step.place else _with_article(step.object or "")
        side = say(f"stand.side_{step.side}", name=name)
        far = "" if step.distance_m is None else f"{step.distance_m:g}"
        return say("order.stand_far" if far else "order.stand", side=side, far=far)

    def _recall(self, step: Recall) -> Bilingual:
        if step.object is None:
            return self._at("order.recall_deeds" if step.deeds else "order.recall", step.place)
        return self._at("order.recall_thing", step.place, object=_with_article(step.object))

    def _holder(self, step: If | Attempt | Repeat) -> Bilingual:
        match step:
            case Attempt():
                return say(
                    "order.try", steps=self.row(step.steps), otherwise=self.row(step.on_failure)
                )
            case Repeat():
                return self._rounds(step)
            case _:
                when = self._condition(step.when)
                facts = {"when": when, "then": self.row(step.then)} if step.then else {"when": when}
                if not step.otherwise:
                    return say("order.if", **facts)
                code = "order.if_else" if step.then else "order.unless"
                return say(code, otherwise=self.row(step.otherwise), **facts)

    def _rounds(self, step: Repeat) -> Bilingual:
        steps = self.row(step.steps)
        if step.until is not None:
            return say("order.until", steps=steps, when=self._condition(step.until))
        if step.seconds < MAX_LOOP_S:
            return say("order.again_for", steps=steps, span=_tell_span(step.seconds))
        if step.times < MAX_ROUNDS:
            return say("order.times", steps=steps, times=str(step.times))
        return say("order.again", steps=steps)

    def _condition(self, when: Condition) -> Bilingual:
        match when:
            case Look():
                return self._at("order.when_look", when.place, question=when.question)
            case Find():
                return self._at("order.when_find", when.place, object=_with_article(when.object))
            case Ask():
                return say("order.when_ask", text=when.question)
            case ClockTime():
                code = "order.when_after" if when.after else "order.when_before"
                return say(code, time=when.after or when.before or "")
            case _:
                what = _with_article(when.object or "")
                return self._at("order.when_recall", when.place, object=what)


def _tell_plain(step: Step) -> Bilingual:
    """Return what a step does that names no place and holds no other."""
    match step:
        case Wait():
            return say("order.wait", span=_tell_span(step.seconds))
        case Say():
            return say("order.say", text=step.text)
        case Ask():
            return say("order.ask", text=step.question)
        case Follow():
            what = _with_article(step.object)
            if step.seconds is None:
                return say("order.follow", object=what)
            return say("order.follow_for", object=what, span=_tell_span(step.seconds))
        case Turn():
            angle_deg = round(degrees(step.angle_rad))
            return say("order.left" if angle_deg > 0 else "order.right", angle_deg=abs(angle_deg))
        case MoveStraight():
            code = "order.forward" if step.distance_m > 0 else "order.back"
            return say(code, far=f"{abs(step.distance_m):g}")
        case WaitFor(object=str(what)):
            return say("order.wait_for", object=_with_article(what))
        case WaitFor(word=str(word)):
            return say("order.wait_word", word=word)
        case UseSkill() | UseTool():
            return _tell_call(step)
        case WaitFor():
            return say("order.wait_until", time=step.time or "")
        case _:
            known = step.kind in _ALONE
            return say(_ALONE[step.kind]) if known else say_or_quote("step_kind", step.kind)


def _tell_call(step: UseSkill | UseTool) -> Bilingual:
    if isinstance(step, UseSkill):
        return say("order.use_skill", name=step.name.replace("_", " "))
    return say("order.use_tool", call=name_call(step.tool, step.arguments))


def name_call(tool: str, arguments: tuple[str, ...]) -> str:
    """Name a call of a tool with all its arguments: ``mail: send (Anna; dinner)``."""
    given = "; ".join(each for each in arguments if each)
    return tool.replace(".", ": ", 1) + (f" ({given})" if given else "")


def _with_article(label: str) -> Bilingual:
    """Put the article before a thing, where the language has one; a name or "my keys" has none."""
    owned = label.split(" ", 1)[0].casefold() in _OWNED
    if label[:1].isupper() or owned or not label.isascii():
        return tell_words(label)
    return say("order.the", object=tell_words(label))


_OWNED = frozenset(
    {"a", "an", "the", "my", "our", "your", "his", "her", "their", "me", "this", "that", "some"}
    | {"any", "anyone", "anybody", "anything", "someone", "somebody", "everyone", "everybody"}
)
