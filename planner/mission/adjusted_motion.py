"""Say what a turn or a drive becomes that a person adjusts: "a bit more", "the other left!".

Pure. Laws: the newest order is one turn or one straight drive and nothing else; a turn that is
corrected ends where the right one would have ended, as far as it is known how far it came; and what
is in doubt stays as it was said. What comes of it is an order like any other.
"""

from __future__ import annotations

import re
from math import degrees, pi
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import plain

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.plan import StepRecord
    from wire import Pose2

BIT_DEG = 30
"""Of "a bit more" after a turn, as the grammar offers it for "turn left a bit"."""
_FACES = frozenset({"go_to_object", "stand_at"})
"""After these the robot faces what it came for, so that "closer" is straight ahead."""
MAX_READ = 60
_ENDS = " .!,;:。~…，；！"
_OPEN = (
    r"(?:(?:ok|okay|well|um+|uh+|oh|and|just|yes|yeah|nearly|almost|please|robot|pons|still|good"
    r"|great|lovely|now|then)[ ,.!;]+)*"
)
_CLOSE = r"(?:[ ,]+(?:please|thanks|thank you|now|then|again|mate|love|dear|darling))*"
_BIT = (
    r"(?:(?:just )?(?:a |one )?(?:(?:tiny |wee |little )?(?:bit|touch|tad|smidge)|little)|some"
    r"|slightly)"
)
_WAY = (
    r"(?: (?:(?:to )?(?:the |your )?(?P<side>left|right)|(?P<ahead>forwards?|ahead)"
    r"|(?P<back>backwards?|back)))?"
)
_MUCH = (
    r"(?P<much>(?:(?:\d{1,3}(?:\.\d)?|a|one|two|half an?|half|ten|twenty|thirty"
    r"|fifty) ?)?(?P<unit>metres?|meters?|m|cm|centimet(?:er|re)s?|degrees?))"
)
_MORE = re.compile(
    rf"{_OPEN}(?:(?:go|move|drive|turn) )?(?:(?:{_BIT} (?:more|further|farther)|more|further){_WAY}"
    rf"|another {_MUCH}|keep going {_BIT}(?: more)?)(?:[ ,]+(?:{_BIT} )?more)*{_CLOSE}"
)
_CLOSER = re.compile(rf"{_OPEN}(?:{_BIT} )?(?:closer|nearer){_CLOSE}")
_BACK = re.compile(
    rf"{_OPEN}(?:(?:that(?:'s| is| was)? )?(?:too (?:far|much)|much too far|over)[ ,.!;]+)?"
    rf"(?:(?:now |so |just )*(?:go|come|turn|move|drive) )?(?:back {_BIT}"
    rf"|{_BIT} (?:further )?back(?:wards)?){_CLOSE}"
)
_FORTH = re.compile(
    rf"{_OPEN}(?:(?:that(?:'s| is| was)? )?(?:too (?:far|much)|much too far)[ ,.!;]+)"
    rf"(?:(?:now |so |just )*(?:go|come|move|drive) )?(?:forwards? {_BIT}|{_BIT} forwards?){_CLOSE}"
)
_NO = (
    r"(?:(?:no|nope|wait|oops|sorry|hey|not that way|wrong (?:way|side|direction|one)|the wrong way"
    r"|actually|robot)[ ,.!;]+)"
)
_SIDE = r"(?:(?:turn|go) )?(?:to )?(?:the |your |my )?(?P<{}>left|right)"
_OTHER = re.compile(
    rf"{_NO}*(?:i (?:meant|said) )?(?:turn |go )?(?:to )?(?:the|your|my) other (?:way|side"
    rf"|direction|left|right)"
    rf"(?:[ ,.!;]+(?:i (?:meant|said|mean) )?{_SIDE.format('a')}(?: i (?:meant|mean"
    rf"|said))?)?{_CLOSE}"
    rf"|{_NO}+{_SIDE.format('b')}(?: i (?:meant|mean|said))?(?:[ ,]+not (?:left|right))?{_CLOSE}"
    rf"|{_NO}*i (?:meant|said) {_SIDE.format('c')}(?:[ ,]+not (?:left|right))?{_CLOSE}"
    rf"|{_NO}*{_SIDE.format('d')}[ ,]+(?:i (?:meant|mean|said)|not (?:left|right)){_CLOSE}"
    rf"|(?:no[ ,.!;]+)?(?:that's |that is )?(?:the )?wrong (?:way|direction|side){_CLOSE}"
    rf"(?:[ ,.!;]+{_SIDE.format('e')}{_CLOSE})?"
)
_MORE_ZH = re.compile(
    r"(?:好|嗯|对|行|可以|还|就|快到了|差不多|,)*(?:(?:再|还要?|多)(?:多|稍微|往那边|(?:往"
    r"|向)?(?P<side>左|右)边?)?(?:来|走|转"
    r"|开|过去|动)?(?:多)?"
    r"(?:一点点?|点儿?|一些|一丢丢)|还?(?:不够|差一点|差点)(?:,?再(?:来|走|转"
    r"|过去)?一?点)?)(?:就好|就行|吧|了|啊)*"
)
_MUCH_ZH = re.compile(
    r"再(?:来|走|转|开|往前走?|前进|退|后退)?(?P<much>(?:\d{1,3}"
    r"|[一二两三半十]{1,3})(?:个)?(?P<unit>米|厘米|公分|度))(?:吧|就好|就行|啊)*"
)
_CLOSER_ZH = re.compile(r"(?:再)?(?:靠|走|开|离)?(?:得)?近(?:一点|点儿?|一些)(?:吧|啊|嘛)*")
_BACK_ZH = re.compile(
    r"(?:[哎诶啊]|,)*(?:(?:转|走|开)?(?:多|过头?|太多|太远)了?,?)*(?:你)?(?:再)?(?:往|向)?(?:转|走"
    r"|退|倒|开)?"
    r"(?:回来?|回去|后退?|退)(?:转|走|开|动|来|去)?(?:一点点?|点儿?|一些)(?:吧|就好|啊|就行)*"
)
_OTHER_ZH = re.compile(
    r"(?:不对|不是|错了|反了|不|哎|诶|,)*(?:(?:我说的|我要的|我|应该|说的)?是?(?:往|向"
    r"|转)?(?:另一?边|另外一边|另一个方向|反方向|相反方向)"
    r"|(?:转|走|方向)?(?:反|错)了?(?:方向)?)(?:,?(?:是|往|向|应该是|应该往)?(?P<a>左|右)(?:边"
    r"|转)?)?(?:啊|呀|吧|了)*"
    r"|(?:不对|不是|错了|反了|不),?(?:应该|我说的|我要的|我)?(?:是)?(?:往|向|转)?(?P<b>左|右)(?:边"
    r"|转)?(?:啊|呀|吧|才对)*"
    r"|我(?:说|要|指)的?是?(?:往|向)?(?P<c>左|右)(?:边|转)?(?:啊|呀|吧)*"
)


def adjust_motion(text: str, last: Mission) -> str | None:
    """Return the motion that a person's word asks for; None where it asks for none.

    Args:
        text: as it was said.
        last: the newest order.
    """
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    bare = "".join(said.split()).replace("，", ",") if chinese else said
    if not 0 < len(bare) <= MAX_READ:
        return None
    faces = bool(last.steps) and last.steps[-1].kind in _FACES
    if faces and (_CLOSER_ZH if chinese else _CLOSER).fullmatch(bare):
        return "往前一点" if chinese else "move forward a bit"
    step = _only_step(last)
    if step is None or text.rstrip().endswith(("?", "？")):
        return None
    more = (_MORE_ZH if chinese else _MORE).fullmatch(bare)
    much = _MUCH_ZH.fullmatch(bare) if chinese else more if more and more["much"] else None
    if much is not None:
        return _move_as_far(step, much["much"], much["unit"], chinese=chinese)
    if more is not None:
        return None if _turns_elsewhere(step, more) else _move_on(step, 1.0, chinese=chinese)
    if (_CLOSER_ZH if chinese else _CLOSER).fullmatch(bare):
        nears = step.kind == "move" and (step.distance_m or 0.0) > 0.0
        return _move_on(step, 1.0, chinese=chinese) if nears else None
    if (_BACK_ZH if chinese else _BACK).fullmatch(bare):
        return _move_on(step, -1.0, chinese=chinese)
    if not chinese and step.kind == "move" and _FORTH.fullmatch(bare):
        return "move forward a bit"
    return None


def turn_other_way(text: str, last: Mission, here: Pose2 | None) -> str | None:
    """Return the turn to the other side that "the other left!" asks for; None: another sentence."""
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    bare = (
        re.sub(r"\s|，|。|！|!", lambda m: "" if m[0].isspace() else ",", said) if chinese else said
    )
    step = _only_step(last)
    found = (_OTHER_ZH if chinese else _OTHER).fullmatch(bare)
    if found is None or step is None or step.kind != "turn" or not step.angle_rad:
        return None
    side = next((side for side in found.groups() if side), None)
    to_left = step.angle_rad < 0.0
    if side is not None and (side in ("left", "左")) is not to_left:
        return None  # the side that it turns to already
    wanted = abs(degrees(step.angle_rad))
    come = wanted if last.has_ended else _turned_deg(last, here)
    angle = round(wanted + min(come, wanted)) if wanted < 180.0 else round(wanted)
    if chinese:
        return f"向{'左' if to_left else '右'}转{angle}度"
    return f"turn {'left' if to_left else 'right'} by {angle} degrees"


def _only_step(last: Mission) -> StepRecord | None:
    step = last.steps[0] if len(last.steps) == 1 else None
    return step if step is not None and step.kind in ("turn", "move") else None


def _turned_deg(last: Mission, here: Pose2 | None) -> float:
    """Return how far a turn under way has come; 0 where that is unknown."""
    if here is None or last.accepted_at is None:
        return 0.0
    turned = (here.yaw_rad - last.accepted_at[2] + pi) % (2.0 * pi) - pi
    return abs(degrees(turned))


def _turns_elsewhere(step: StepRecord, more: re.Match[str]) -> bool:
    """Tell whether "a bit more to the left" names another way than the motion before."""
    said = {side: words for side, words in more.groupdict().items() if words}
    left, ahead = (step.angle_rad or 0.0) > 0.0, (step.distance_m or 0.0) > 0.0
    if step.kind == "turn":
        return bool(said.keys() - {"side"}) or said.get("side", "") in (
            ("right", "右") if left else ("left", "左")
        )
    return bool(said.keys() - {"back" if not ahead else "ahead"})


def _move_as_far(step: StepRecord, much: str, unit: str, *, chinese: bool) -> str | None:
    """Return so much more of the same motion; None where it is measured otherwise."""
    if (step.kind == "turn") is not unit.startswith(("degree", "度")):
        return None
    if step.kind == "turn":
        left = (step.angle_rad or 0.0) > 0.0
        return (
            f"向{'左' if left else '右'}转{much}"
            if chinese
            else (f"turn {'left' if left else 'right'} by {much}")
        )
    ahead = (step.distance_m or 0.0) > 0.0
    if chinese:
        return f"{'前进' if ahead else '后退'}{much}"
    much = f"a {much}" if much == unit else re.sub(r"^half (?=m)", "half a ", much)
    return f"move {'forward' if ahead else 'back'} {much}"


def _move_on(step: StepRecord, way: float, *, chinese: bool) -> str | None:
    """Return a little of the same motion, or of the opposite one."""
    if step.kind == "move":
        ahead = way * (step.distance_m or 0.0)
        if chinese:
            return "往前一点" if ahead > 0.0 else "后退一点"
        return f"move {'forward' if ahead > 0.0 else 'back'} a bit"
    left = way * (step.angle_rad or 0.0) > 0.0
    if chinese:
        return f"向{'左' if left else '右'}转{BIT_DEG}度"
    return f"turn {'left' if left else 'right'} by {BIT_DEG} degrees"
