"""Own the outcome codes and their sentences: one table, both languages, stable codes.

Whatever a goal ends in has one of these codes, and a person reads its sentence. A code is never
renamed; a sentence may be.
"""

from __future__ import annotations

from enum import StrEnum

from planner.plan.base import Bilingual


class Code(StrEnum):
    """Why a goal ended, or waits for a person."""

    # Understood or not: said before anything moves.
    EMPTY_GOAL = "empty_goal"
    TEXT_TOO_LONG = "text_too_long"
    BAD_TEXT = "bad_text"
    NOT_UNDERSTOOD = "not_understood"
    UNKNOWN_PLACE = "unknown_place"
    AMBIGUOUS = "ambiguous"
    INCOMPLETE = "incomplete"
    NEGATED = "negated"
    CONDITIONAL = "conditional"
    OUT_OF_SCOPE = "out_of_scope"
    NO_CAPABILITY = "no_capability"
    NO_CAMERA = "no_camera"
    NO_DETECTOR = "no_detector"
    OBJECT_UNKNOWN = "object_unknown"
    UNSAFE = "unsafe"
    BAD_PLAN = "bad_plan"
    MODEL_UNAVAILABLE = "model_unavailable"
    NOT_ARMED = "not_armed"
    PLACE_NOT_KEPT = "place_not_kept"
    # On the way.
    CONFIRM = "confirm"
    ASKED = "asked"
    NO_ANSWER = "no_answer"
    DECLINED = "declined"
    NO_ROOM = "no_room"
    NOT_REACHED = "not_reached"
    NO_ROUTE = "no_route"
    BLOCKED = "blocked"
    BLIND = "blind"
    NOT_FOUND = "not_found"
    LOST_PERSON = "lost_person"
    POINT_REFUSED = "point_refused"
    STOPPED = "stopped"
    FAULT = "fault"
    OUT_OF_BUDGET = "out_of_budget"
    # The end.
    ARRIVED = "arrived"
    FOUND = "found"
    COUNTED = "counted"
    SEEN = "seen"
    FOLLOWED = "followed"
    DONE = "done"
    ANSWERED = "answered"
    CANCELLED = "cancelled"


_SENTENCES: dict[Code, tuple[str, str]] = {
    Code.EMPTY_GOAL: (
        "There is no order in this. Tell me where to go, for example: {example}",
        "没有看到指令。请告诉我要去哪里，例如：{example}",
    ),
    Code.TEXT_TOO_LONG: (
        "The order has {length} characters; at most {limit} are read.",
        "指令有 {length} 个字符，最多只读 {limit} 个。",
    ),
    Code.BAD_TEXT: (
        "The order holds characters that are not text ({found}). Please write plain words.",
        "指令里有不是文字的字符（{found}），请用普通文字书写。",
    ),
    Code.NOT_UNDERSTOOD: (
        "I did not understand “{part}”. Please say it another way.",
        "我没听懂“{part}”。请换个说法。",
    ),
    Code.UNKNOWN_PLACE: (
        "I know no place called “{name}”.{near} Known places: {known}.",
        "我不知道叫“{name}”的地方。{near}已知的地方：{known}。",
    ),
    Code.AMBIGUOUS: (
        "“{part}” can mean more than one thing. Which one?",
        "“{part}”可能有不止一个意思，您指的是哪一个？",
    ),
    Code.INCOMPLETE: (
        "Something is missing in “{part}”: {what}",
        "“{part}”里缺少信息：{what}",
    ),
    Code.NEGATED: (
        "You said “{part}”: I take that as an order not to do it, and plan no motion for it.",
        "您说了“{part}”：我理解为不要这样做，因此不会为此移动。",
    ),
    Code.CONDITIONAL: (
        "I can't check the condition “{part}”, so I begin nothing. Give the order without it.",
        "我无法判断“{part}”这个条件，所以不会开始。请直接下达不带条件的指令。",
    ),
    Code.OUT_OF_SCOPE: (
        "Speeds and coordinates are not mine to choose (“{part}”). Name a place instead.",
        "速度和坐标不由指令决定（“{part}”）。请说地点名称。",
    ),
    Code.NO_CAPABILITY: (
        "I can't do “{part}”: as it is said, that is beyond this robot.",
        "我做不到“{part}”：照这样说，这台机器人做不到。",
    ),
    Code.NO_CAMERA: (
        "I can't do “{part}”: it needs a camera, and there is none.",
        "我做不到“{part}”：这需要摄像头，而现在没有。",
    ),
    Code.NO_DETECTOR: (
        "I can't do “{part}”: there is a camera, but nothing here recognises what it shows.",
        "我做不到“{part}”：有摄像头，但没有能识别画面的模型。",
    ),
    Code.OBJECT_UNKNOWN: (
        "I can't recognise “{name}”. What I can: {known}.",
        "我认不出“{name}”。我能认出：{known}。",
    ),
    Code.UNSAFE: (
        "I will not do “{part}”: {rule}.",
        "我不会做“{part}”：{rule}。",
    ),
    Code.BAD_PLAN: (
        "The plan was not usable: {why}.",
        "计划不可用：{why}。",
    ),
    Code.MODEL_UNAVAILABLE: (
        "The planning model does not answer, and the built-in brain can't do this alone.",
        "规划模型没有应答，而内置大脑无法独自完成这个任务。",
    ),
    Code.NOT_ARMED: (
        "The robot is not armed. Arm it, then resume the goal.",
        "机器人未解锁。请先解锁，再继续任务。",
    ),
    Code.PLACE_NOT_KEPT: (
        "The memory of places is as it was: {why}.",
        "地点记忆没有改变：{why}。",
    ),
    Code.CONFIRM: (
        "The plan has changed: {why}. Say yes or no.",
        "计划有变：{why}。请回答“是”或“不”。",
    ),
    Code.ASKED: (
        "{text}",
        "{text}",
    ),
    Code.NO_ANSWER: (
        "Nobody answered “{text}” within {seconds} s, so the goal ends.",
        "“{text}”在 {seconds} 秒内没有得到回答，任务到此结束。",
    ),
    Code.DECLINED: (
        "You said {said}, so I do not {deed}.",
        "您{said}，所以我不{deed}。",
    ),
    Code.NO_ROOM: (
        "There is room for {room} m in a straight line, not for {asked} m.",
        "直线方向只有 {room} 米的空间，不够 {asked} 米。",
    ),
    Code.NOT_REACHED: (
        "Asked for {asked}, but odometry says {reached}.",
        "要求{asked}，但里程计显示{reached}。",
    ),
    Code.NO_ROUTE: (
        "I found no way to {place}.",
        "找不到去{place}的路。",
    ),
    Code.BLOCKED: (
        "The way to {place} is blocked.",
        "去{place}的路被挡住了。",
    ),
    Code.BLIND: (
        "I can't see now ({why}).",
        "我现在看不见（{why}）。",
    ),
    Code.NOT_FOUND: (
        "I saw no {thing}. {looked}",
        "没有看到{thing}。{looked}",
    ),
    Code.LOST_PERSON: (
        "I see nobody to follow any more: nobody was in sight for {seconds} s.",
        "跟丢了：{seconds} 秒内没有看到人。",
    ),
    Code.POINT_REFUSED: (
        "I can't drive to that point of the picture: {why}.",
        "无法开到画面中的那个位置：{why}。",
    ),
    Code.STOPPED: (
        "Stopped.",
        "已停下。",
    ),
    Code.FAULT: (
        "The bridge stopped the robot: {row}.",
        "安全桥停下了机器人：{row}。",
    ),
    Code.OUT_OF_BUDGET: (
        "The goal used up its {budget}.",
        "任务的{budget}已用完。",
    ),
    Code.ARRIVED: (
        "Arrived: {place}.",
        "已到达：{place}。",
    ),
    Code.FOUND: (
        "{text}",
        "{text}",
    ),
    Code.COUNTED: (
        "{text}",
        "{text}",
    ),
    Code.SEEN: (
        "{text}",
        "{text}",
    ),
    Code.FOLLOWED: (
        "I followed for {seconds} s, {metres} m.",
        "跟随了 {seconds} 秒，{metres} 米。",
    ),
    Code.DONE: (
        "Done.",
        "已完成。",
    ),
    Code.ANSWERED: (
        "{text}",
        "{text}",
    ),
    Code.CANCELLED: (
        "Cancelled.",
        "已取消。",
    ),
}


def template(code: Code) -> Bilingual:
    """Return the sentence of a code with its blanks still open."""
    en, zh = _SENTENCES[code]
    return Bilingual(en=en, zh=zh)


def message(code: Code, **facts: str | int | float | Bilingual) -> Bilingual:
    """Fill in the sentence of a code; a bilingual fact fills each language with its own words.

    Raises:
        KeyError: a blank of the sentence was given no fact.
    """
    en, zh = _SENTENCES[code]
    return Bilingual(
        en=en.format(**{key: _in(fact, "en") for key, fact in facts.items()}),
        zh=zh.format(**{key: _in(fact, "zh") for key, fact in facts.items()}),
    )


def _in(fact: str | int | float | Bilingual, language: str) -> str:
    if isinstance(fact, Bilingual):
        return fact.en if language == "en" else fact.zh
    return str(fact)
