"""Account for the steps of a goal that ends: each one's result, in order, for a person. Pure.

Law: "Arrived" is said of a place only where the last drive to it came there; what was said, asked
and answered stands in it; so does what the detector saw, whatever a model says after it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import join, list_names, message, say
from planner.language.formatting import angle, definite, metres
from planner.language.object_names import tell_words
from planner.plan import Bilingual, Code, StepRecord, StepState, say_same
from planner.plan.plan_walk import is_left_open

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from planner.mission.state import Mission, Planning, Progress
    from planner.site.site_view import SiteView

DRIVEN = frozenset({"go_to", "go_to_pose", "return_home", "come_back"})
MOTION = DRIVEN | {"stand_at", "turn", "move", "patrol", "explore"}
BACK = frozenset({"come_back", "return_home"})
_OVER = frozenset({StepState.SUCCEEDED, StepState.FAILED})
_IDLE = frozenset({StepState.PENDING, StepState.SKIPPED})
_READ_ALONE = frozenset({"look", "use_tool"})
"""A look's reading, or a tool's answer, is the whole answer of its step."""
_WORDED = {"say": "account.saying", "ask": "account.asking", "look": "account.looking"}
_OBJECT_STEPS = frozenset({"find", "count", "follow", "go_to_object"})


def account(facts: SiteView, mission: Mission, code: Code, said: Bilingual | None) -> Bilingual:
    """Return each step's result, and ``said`` where no step has said it yet.

    Args:
        facts: the site's names.
        mission: as it stands at its end.
        code: how it ends.
        said: how it ends in words; None: the steps tell it all.
    """
    told = list(_tell_steps(facts, mission))
    if said is not None and not any(
        each.en.endswith(said.en) for each in (*told, _join_sentences(told))
    ):
        told.append(said)
    left = _undone(facts, mission, code)
    if left is not None:
        told.append(left)
    return _join_sentences(told) if told else message(Code.DONE)


def outcome_code(mission: Planning) -> Code:
    """Return the code of a goal whose steps are all over: that of its last step that counts.

    Words and waits count for nothing; after a drive that failed nobody has arrived.
    """
    for step in reversed(mission.steps):
        if step.kind in MOTION and step.state is StepState.FAILED:
            return Code.DONE
        if step.state is not StepState.SUCCEEDED:
            continue
        if step.said is not None:
            return step.code or Code.SEEN
        if step.kind in MOTION:
            return Code.DONE if step.kind in ("turn", "move") else Code.ARRIVED
    return Code.DONE


def place_name(facts: SiteView, mission: Mission, step: StepRecord | None) -> Bilingual:
    """Name a step's destination for a person."""
    if step is not None and step.kind == "come_back":
        return say("account.start")
    if step is not None and step.kind in ("turn", "move"):
        return say("account.goal_pose")
    if step is not None and step.kind == "go_to_pose":
        return name_point(step)
    if step is not None and step.kind == "explore":
        return say("account.frontier")
    wanted = facts.home if step is not None and step.kind == "return_home" else None
    return name_place(facts, wanted or (_place(mission, step) if step is not None else ""))


def name_point(step: StepRecord) -> Bilingual:
    """Name a point of the map that a person gave: ``point (3.20, 4.10)``."""
    return say("account.point", x_m=f"{step.x_m or 0.0:.2f}", y_m=f"{step.y_m or 0.0:.2f}")


def _place(mission: Progress, step: StepRecord) -> str:
    """Return the place that a step is at: of a patrol the one whose turn it is, or the last."""
    if step.places:
        done = len(step.stops) if step.look else mission.part
        visited = len(step.places) if step.state is StepState.SUCCEEDED else done
        return step.places[min(visited, len(step.places) - 1)]
    return step.place or ""


def name_place(facts: SiteView, place: str) -> Bilingual:
    """Name a place for a person; one that is not known by its id."""
    target = facts.targets.get(place)
    return target.name if target is not None else say_same(place or "?")


def _tell_steps(facts: SiteView, mission: Mission) -> Iterator[Bilingual]:
    """Yield the sentences of the steps that were begun; arrivals in a row are one."""
    steps, arrived, instead = mission.steps, list[Bilingual](), False
    mended = _find_replan(mission)
    for index, step in enumerate(steps):
        if step.kind in DRIVEN and step.state is StepState.SUCCEEDED:
            if _is_answered_there(steps, index):
                continue
            name = place_name(facts, mission, step)
            if not _failed_later(facts, mission, index):
                arrived.append(name)
                continue
            sentences = [say("account.been_to", name=name)]
        else:
            sentences = [*step.earlier, *_sentences(facts, step)]
        if arrived and sentences:
            yield from _after(_tell_arrivals(arrived), instead=instead)
            arrived, instead = [], False
        for sentence in sentences:
            yield from _after(sentence, instead=instead)
            instead = False
        instead = instead or (step.state is StepState.FAILED and index < mended)
    if arrived:
        yield from _after(_tell_arrivals(arrived), instead=instead)


def _is_answered_there(steps: Sequence[StepRecord], index: int) -> bool:
    """Tell whether a drive led to what was looked at next: that answer names it, and is first."""
    row = steps[index : index + 2]
    if len(row) < 2 or row[0].place is None or row[0].place != row[1].place:
        return False
    looked = row[1].kind in ("look", "count") and row[1].state is StepState.SUCCEEDED
    return looked and row[1].said is not None


def _after(sentence: Bilingual, *, instead: bool) -> Iterator[Bilingual]:
    """Yield a sentence; where a step had failed before it, tell it as done in place of that."""
    yield say("account.instead", sentence=sentence) if instead else sentence


def _find_replan(mission: Planning) -> int:
    """Return before which step another plan has taken the place of each that failed."""
    if mission.failure is None:
        return len(mission.steps)
    failed = [i for i, step in enumerate(mission.steps) if step.state is StepState.FAILED]
    there = [i for i in failed if mission.steps[i].kind not in BACK]
    return max(there or failed, default=0)


def _failed_later(facts: SiteView, mission: Mission, index: int) -> bool:
    """Tell whether a later drive to the same place did not come there."""
    name = place_name(facts, mission, mission.steps[index])
    later = (s for s in mission.steps[index + 1 :] if s.kind in DRIVEN and s.state not in _IDLE)
    last = [step for step in later if place_name(facts, mission, step) == name]
    return bool(last) and last[-1].state is not StepState.SUCCEEDED


def _tell_arrivals(names: Sequence[Bilingual]) -> Bilingual:
    return message(Code.ARRIVED, place=join(names, "joint.then"))


def _sentences(facts: SiteView, step: StepRecord) -> Iterator[Bilingual]:
    """Yield what came of one step; nothing of one that was not begun."""
    if step.stops:
        if step.state is not StepState.SUCCEEDED:  # its own report has them all
            yield from (stop.said for stop in step.stops)
    elif step.visited and step.places:
        names = [name_place(facts, place) for place in step.places[: step.visited]]
        yield say("account.visited", names=list_names(names))
    if step.answer is not None:
        yield _tell_answer(step)
    if step.said is not None and step.state in _OVER:
        if step.read is not None:
            yield step.read
        if step.read is None or step.kind not in _READ_ALONE:
            yield step.said
    elif step.state is StepState.SUCCEEDED or (step.kind == "repeat" and step.round > 1):
        yield from _tell_deed(step)
    elif step.reason == "perhaps_said":
        text = step.text or ""
        yield say("account.perhaps_said", text=text)


def _tell_answer(step: StepRecord) -> Bilingual:
    if step.kind != "ask":  # its question is in no record
        return say("account.answered", answer=step.answer)
    return say("account.asked", text=step.text, answer=step.answer)


def _tell_deed(step: StepRecord) -> Iterator[Bilingual]:
    """Yield what a step did that has no words of its own."""
    match step.kind:
        case "turn":  # as it was asked for: the record has how near it came
            yield say("account.turned", put=angle(step.angle_rad or 0.0))
        case "move":
            yield say("account.moved", put=metres(step.distance_m or 0.0))
        case "wait":
            seconds = f"{step.seconds or 0.0:g}"
            yield say("account.waited", seconds=seconds)
        case "say":
            yield say("account.said", text=(step.text or "").rstrip("。."))
        case "go_to_point":
            yield say("account.at_point")
        case "repeat" if step.round > 1:
            whole = step.state is StepState.SUCCEEDED and step.round == step.times
            code = "account.all_rounds" if whole else "account.rounds"
            yield say(code, count=step.round, times=step.times)


def _undone(facts: SiteView, mission: Mission, code: Code) -> Bilingual | None:
    """Name the steps that nothing else accounts for; of a plan of one step its end is enough."""
    if code in (Code.CANCELLED, Code.DECLINED) or len(mission.steps) < 2:
        return None
    names = [
        name
        for index, step in enumerate(mission.steps)
        if not is_left_open(mission.steps, index)
        and (name := _name_undone(facts, mission, step)) is not None
    ]
    if not names:
        return None
    return say("account.not_done", names=list_names(names))


def _name_undone(facts: SiteView, mission: Mission, step: StepRecord) -> Bilingual | None:
    """Name a step that was not done and of which nothing was said; else None."""
    said = step.said is not None or step.answer is not None or step.reason == "perhaps_said"
    if step.state is StepState.SUCCEEDED or said or step.kind == "decide":
        return None
    if step.kind == "ask" and step.state is StepState.RUNNING:  # that nobody answered is told
        return None
    return _name_step(facts, mission, step)


def _name_step(facts: SiteView, mission: Mission, step: StepRecord) -> Bilingual:
    """Name what a step asks for: ``going to the kitchen``, ``去厨房``."""
    text = step.object or step.text or ""
    if step.kind in _OBJECT_STEPS:
        return say(f"account_thing.{step.kind}", what=tell_words(text))
    match step.kind:
        case "say" | "ask" | "look":
            return say(_WORDED[step.kind], text=text)
        case "recall":
            return say("account.recalling")
        case "use_tool":
            return say("account.asking_tool", tool=step.tool)
        case "wait":
            return say("account.waiting", seconds=f"{step.seconds or 0.0:g}")
        case "wait_for":
            what = step.object or step.word or step.time or ""
            return say("account.waiting_for", what=what)
        case "turn" | "move":
            turns = step.kind == "turn"
            put = angle(step.angle_rad or 0.0) if turns else metres(step.distance_m or 0.0)
            return say("account.turning" if turns else "account.driving", put=put)
        case "patrol":
            names = [name_place(facts, place) for place in step.places[step.visited or 0 :]]
            return say("account.visiting", names=list_names(names))
        case "stand_at":
            name = name_place(facts, step.place) if step.place else say_same(text)
            return say("account.standing", side=say(f"stand.side_{step.side}", name=name))
        case "go_to_point":
            return say("account.going_to_point")
        case "explore":
            return say("account.exploring")
        case _:
            name = place_name(facts, mission, step)
            return say("account.going_to", name=definite(name))


def _join_sentences(told: Sequence[Bilingual]) -> Bilingual:
    """Return sentences as one text; of two equal ones in a row one is told."""
    kept = [each for at, each in enumerate(told) if at == 0 or each != told[at - 1]]
    return join(kept)
