"""Find the steps that move the robot and that a sentence does not name, by its words alone.

Each kind of step has words of its own here, never a brain's. `pons eval` judges every plan by them,
and a model's plan is held to them before it is walked (`unasked_motion`), more strictly: there a
person, too, must be spoken of before one is looked for.
"""

from __future__ import annotations

import re
from math import degrees

from planner.language.motion_guard.mentioned_names import (
    find_places,
    label_named,
    numbers_named,
    places_named,
    plain,
    thing_named,
)
from planner.plan import (
    DRIVES,
    STANDS,
    ClockTime,
    ComeBack,
    Count,
    Explore,
    Find,
    Follow,
    GoToObject,
    GoToPoint,
    Look,
    MoveStraight,
    Patrol,
    ReturnHome,
    StandAt,
    Step,
    StepPlan,
    Turn,
    Vocabulary,
    list_nodes,
    places_of,
)

_HOME = (
    r"home|base|dock|charg|\brest\b|\bsleep|\bnap\b|家|窝|充电|基地|返航|回桩|回充|休息|歇|睡|躺"
)
_BACK = r"back|return|here|where you (?:are|started)|回|返|过来|原"
_FOLLOW = r"follow|after|behind|come with|跟|随|尾"
_LEFT, _RIGHT = r"left|counter|anti|左|逆", r"right|(?<!counter)(?<!anti)clockwise|右|顺"
_TURN = r"turn|spin|rotat|face|around|degree|radian|circle|转|掉个?头|调头|偏|方向|圈|朝"
_FORWARD = r"forward|ahead|straight|front|front|前|直"
_BACKWARD = r"back|reverse|(?<![然之以最])后|退|倒"
_EXPLORE = r"explor|map|survey|探索|探查|勘探|地图|建图"
_MOVE = rf"move|go|drive|walk|come|step|roll|走|移|进|行|开|{_FORWARD}|{_BACKWARD}"
_USUAL_DEG = {
    90.0: r"left|right|左|右",
    180.0: r"around|u-turn|about|half (?:a )?(?:turn|circle)|半圈|掉个?头|调头|转过?身|向后|后转",
    360.0: r"circle|spin|full|圈|360",
}
_DEGREES = re.compile(r"degree|\bdeg\b|°|度|radian|弧")
_CLOSE = 0.02  # of the number that was said


def moves(step: Step | ClockTime) -> bool:
    """Tell whether a step moves the robot."""
    return step.kind in DRIVES or (step.kind not in STANDS and bool(places_of(step)))


def evidence(step: Step | ClockTime, said: str) -> int:
    """Return how often words speak of what a step does, for kinds that words alone tell."""
    match step:
        case Follow():
            return len(re.findall(_FOLLOW, said))
        case Turn():
            return len(re.findall(_TURN, said))
        case MoveStraight():
            return len(re.findall(_MOVE, said))
    return 1


def wrong_motions(plan: StepPlan, text: str, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return why each step that moves is not named by the sentence; empty where all are."""
    named = frozenset(places_named(text, vocabulary))
    found = []
    for step in (node.step for node in list_nodes(plan.steps)):
        if moves(step):
            unnamed = [place for place in places_of(step) if place not in named]
            found += [f"{step.kind} to {place}, which is not named" for place in unnamed]
            what = unnamed_part(step, plain(text))
            found += [f"{step.kind}: {what}"] if what else []
    return tuple(found)


def unnamed_part(step: Step | ClockTime, said: str) -> str:
    """Return the part of a step, besides its places, that the sentence does not say."""
    match step:
        case ReturnHome():
            return "" if re.search(_HOME, said) else "no word of home"
        case ComeBack():
            return "" if re.search(_BACK, said) else "no word of coming back"
        case Explore():
            return "" if re.search(_EXPLORE, said) else "no word of exploring"
        case Follow():
            if not re.search(_FOLLOW, said):
                return "no word of following"
            return _label(step.object, said)
        case Find() | Count() | GoToObject():
            return _label(step.object, said)
        case GoToPoint():
            return "a point that no sentence names"
        case StandAt():
            return _stand(step, said)
        case Turn():
            return _turn(degrees(step.angle_rad), said)
        case MoveStraight():
            return _move(step.distance_m, said)
    return ""


def _label(label: str, said: str) -> str:
    return "" if label_named(label, said) else f"{label!r} is not named"


_SIDES = {
    "before": r"before|front|ahead of|opposite|from|away|short of|(?<![之以])前|外|离|远",
    "beside": r"beside|next to|side|\bby\b|near|close|旁|边|侧",
    "behind": r"behind|back of|other side|(?<![然之以最])后",
    "facing": r"\bfac|look(?:ing)? (?:at|to)|turn|toward|面[向朝]|面对|朝|对着|转向|看着",
}
"""Words for where to stand, by the side."""


def _stand(step: StandAt, said: str) -> str:
    if not re.search(_SIDES[step.side], said):
        return f"no word of standing {step.side} it"
    what = _label(step.object, said) if step.object is not None else ""
    if what or step.distance_m is None:
        return what
    return _length(step.distance_m, said)


def _turn(angle_deg: float, said: str) -> str:
    if not re.search(_TURN, said):
        return "no word of turning"
    side = _LEFT if angle_deg > 0 else _RIGHT
    other = _RIGHT if angle_deg > 0 else _LEFT
    if re.search(other, said) and not re.search(side, said):
        return "the other side was said"
    wanted = [*numbers_named(said), *(degrees(number) for number in numbers_named(said))]
    usual = [angle for angle, word in _USUAL_DEG.items() if re.search(word, said)]
    usual = [] if _DEGREES.search(said) else usual
    return _number(abs(angle_deg), [*wanted, *usual])


_WAY = re.compile(
    r"\bin (?:my|our|the) way\b|\blet (?:me|us|\w+) (?:through|past|by)\b|\bmake (?:way|room)\b"
    r"|\bmove over\b|\baside\b|让一?让|让开|让路|挡|借过"
)
_ASIDE_M = 1.0


def makes_way(step: Step | ClockTime, said: str) -> bool:
    """Tell whether a step makes room, as words ask for it without a number or a side."""
    short = isinstance(step, MoveStraight) and abs(step.distance_m) <= _ASIDE_M
    return short and _WAY.search(plain(said)) is not None


def _move(distance_m: float, said: str) -> str:
    if abs(distance_m) <= _ASIDE_M and _WAY.search(said):
        return ""
    if not re.search(_MOVE, said):
        return "no word of moving"
    side, other = (_FORWARD, _BACKWARD) if distance_m > 0 else (_BACKWARD, _FORWARD)
    if re.search(other, said) and not re.search(side, said):
        return "the other way was said"
    return _length(abs(distance_m), said)


def _length(metres: float, said: str) -> str:
    scales = {1.0: r".", 0.01: r"cm|centi|厘米|公分"}
    numbers = [
        n * s for s, word in scales.items() if re.search(word, said) for n in numbers_named(said)
    ]
    return _number(metres, numbers)


def _number(value: float, said: list[float]) -> str:
    near = any(abs(value - number) <= _CLOSE * max(number, 0.05) for number in said)
    return "" if near else f"{value:g} is no number of the sentence"


_GAP = " | "
_PATROLS = re.compile(r"\bpatrol|\brounds?\b|\btour\b|巡")
_FOLLOWS = re.compile(
    r"\bfollow|\b(?:go|goes|come|walk|drive|run|stay|keep) (?:along )?(?:after|behind|with)\b"
    r"|\b(?:track|trail|chase|tag along)\b|随|尾|陪"
    r"|跟(?!.{1,8}?(?:说|讲|聊|打.{0,2}招呼|告诉|道|问))"
)
_SEES = re.compile(
    r"\?|\b(?:look\w*|see|watch|check\w*|inspect\w*|what|who|where|is|are|any|find|describe"
    r"|around|show|tell)\b"
    r"|[看瞧查找吗呢]|什么|谁|有没有|哪"
)
_SEES_ROUND = re.compile(
    r"\b(?:look\w*|see|seen|watch|check\w*|inspect\w*|around|there|describe)\b|\bany(?:one|body)\b"
    r"|[看瞧]|环顾|周围|四周|附近|有没有|有什么|有谁"
)
_WATCHES = re.compile(rf"{_PATROLS.pattern}|{_SEES.pattern}")
_NEARS = re.compile(
    r"\b(?:go|goes|approach|up to|walk|drive|come|near|next to|closer|meet|greet|tell|ask|say|bring"
    r"|guide|lead|take|deliver|move|head|to|follow|join|visit|reach|welcome|introduce)\b"
    r"|靠近|走|去|到|过|开|近|面前|跟前|旁|边|给|问|告诉|招呼|跟|找|接|带"
)
_SIDE_AFTER = re.compile(r"的?(?:正?前[面方]?|后[面方]?|背后)")
_SIDE_BEFORE = re.compile(
    r"(?:in front of|before|behind|(?:front|back) of|away from) (?:(?:the|my|our|your) )?$"
)


def unsaid_kind(step: Step | ClockTime, said: str, things: str, vocabulary: Vocabulary) -> str:
    """Return what no word asks for of the kind of step, or of the thing that it is about.

    Args:
        step: what would be done.
        said: what is ordered.
        things: what is spoken of beside it, where a thing may be named.
        vocabulary: the places whose sides are no way of the robot's own.
    """
    if isinstance(step, Look):
        looks = _SEES if step.place is not None else _SEES_ROUND
        return "" if looks.search(said) else "no word of looking"
    if isinstance(step, Patrol) and step.look and not _WATCHES.search(said):
        return "no word of looking on the way"
    label = getattr(step, "object", None)
    if label is None or isinstance(step, StandAt):
        bare = _without_sides(said, vocabulary) if isinstance(step, MoveStraight) else said
        return unnamed_part(step, bare)
    if not thing_named(label, things):
        return f"{label!r} is not named"
    if step.kind == "go_to_object" and not _NEARS.search(things):
        return "no word of going there"
    follows = step.kind != "follow" or _FOLLOWS.search(said)
    return "" if follows else "no word of following"


def _without_sides(said: str, vocabulary: Vocabulary) -> str:
    """Cut the sides of places: "before the sofa", 沙发前 say nothing of the robot's own way."""
    for place in reversed(find_places(said, vocabulary)):
        after = _SIDE_AFTER.match(said, place.end)
        before = _SIDE_BEFORE.search(said, 0, place.start)
        start = before.start() if before is not None else place.start
        end = after.end() if after is not None else place.end
        said = f"{said[:start]}{_GAP}{said[end:]}"
    return said
