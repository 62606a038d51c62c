"""Tell an order to stop from every other sentence, before any model is asked.

Pure, and needs the standard library alone, so that `pons stop` and the API can use it at once.
A sentence stops the robot where its whole first clause says so, never a part of a clause: "bus
stop", "don't stop" and "stop at the kitchen" are other sentences. "cancel", "abort" and "pause"
standing alone count as stops: whoever says them wants the motion to end, and a stop does that.
"wait" does not: it is a step of a plan. "stop looking", "don't follow me" and their like (quits.py)
stop a robot that searches, counts or follows.
Misspellings: letters held down ("stooop") and the swaps that are no words ("sotp", "stpo") stop;
other words ("shop", "step", "stopped") do not.
"""

from __future__ import annotations

import re
import unicodedata

from planner.brain import quits

_READ = 400  # characters looked at; what a stop says, it says first

_EN_POLITE = (
    r"please|pls|plz|kindly|just|now|right now|right away|immediately|instantly|at once|asap"
    r"|robot|pons|car|you|hey|hi|ok|okay|oh|no|wait|whoa|quick|quickly|fast|thanks|thank you"
    r"|(?:can|could|would|will) you|you (?:can|may|must|should|need to|have to)"
    r"|i said|i want you to|i need you to|i would like you to|i told you to|let us|for me|all"
)
_EN_STOP = r"s+t+o+p+|sotp|stpo|tsop|h+a+l+t+|f+r+e+z+e+"
_EN_PHRASE = (
    rf"(?:{_EN_STOP})(?: (?:it|that|this|there|here|right there|right here|where you are"
    r"|everything|all motion|the (?:robot|car|cart|vehicle)|your motors?|the motors?"
    r"|(?:moving|driving|going|running|rolling|turning|spinning|navigating|following)(?: me)?"
    r"|what you are doing))?"
    r"|come to a (?:stop|halt)|(?:emergency|protective) stop|e ?stop"
    r"|(?:hold|stand|stay|keep) still|stay (?:put|where you are)|hold it|do not move(?: any ?more)?"
    r"|abort|cancel|pause|(?:quit|give up)(?: (?:it|that|this))?|give it up"
    r"|(?:abort|cancel|pause) (?:it|that|everything|the (?:goal|mission|task))"
)
_EN = re.compile(
    rf"(?:(?:{_EN_POLITE}) )*(?:{_EN_PHRASE})(?: (?:{_EN_PHRASE}|{_EN_POLITE}))*"
    r"(?: (?:and|then|but|because)\b.*)?"
)
_EN_QUITS = re.compile(rf"(?:(?:{_EN_POLITE}) )*(?:{quits.ENGLISH})")
_EN_ONLY_POLITE = re.compile(rf"(?:{_EN_POLITE}|quick)(?: (?:{_EN_POLITE}))*")

_ZH_POLITE = (
    r"请|麻烦|拜托|您|你|(?:这个|那个)?机器人|小车|车子|喂|嘿|哎|诶|好了|好的|好|行了|够了"
    r"|赶快|赶紧|马上|立刻|立即|现在|快点|快|先|就|都|给我|帮我|我说|我让你|让机器人|让小车"
    r"|能不能|可不可以|可以|能|必须|得|等等|不行|不对|不好|please|robot|pons|now"
)
_ZH_AFTER = (
    r"了|吧|啊|呀|哦|喔|噢|嘛|哈|谢谢您?你?|拜托|好吗|好不好|行吗|行不行|可以吗|现在|立刻|马上"
    r"|机器人|小车|please|now"
)
_ZH_MOTION = r"移动|运动|行驶|行走|前进|动作|行动|一切(?:动作|行动)|任务|运行|导航|跟随|跟着我"
_ZH_PHRASE = (
    r"停(?:一?下来?|一停|止|车|住|步|机|手)?"
    rf"|停止(?:当前)?(?:{_ZH_MOTION})|停下脚步|急停|紧急停止|紧急停车|刹车|打住|住手|慢着"
    r"|(?:别|不要|不许|不准|勿|莫)再?(?:乱?动|走|跑|开|前进|移动|往前走?)"
    r"|站住|定住|(?:站着|原地|待着)(?:别动|不动|不要动|停下)"
    rf"|(?:中止|终止|取消|暂停)(?:当前)?(?:{_ZH_MOTION})?|stop|halt"
)
_ZH = re.compile(
    rf"(?:{_ZH_POLITE})*(?:{_ZH_PHRASE})(?:{_ZH_PHRASE}|{_ZH_AFTER})*(?:(?:然后|接着|之后).*)?"
)
_ZH_QUITS = re.compile(rf"(?:{_ZH_POLITE})*(?:{quits.CHINESE})")
_ZH_ONLY_POLITE = re.compile(rf"(?:{_ZH_POLITE}|不要|不|别)(?:{_ZH_POLITE})*")

_TRADITIONAL = str.maketrans(
    "別動車請馬給緊機來趕駛進暫這著剎煩託準許終當導險尋數隨蹤檢視邏轉繼續點計統觀結對繞領帶",
    "别动车请马给紧机来赶驶进暂这着刹烦托准许终当导险寻数随踪检视逻转继续点计统观结对绕领带",
)
_DONT = re.compile(r"\bdon'?t\b")
_LETS = re.compile(r"\blet'?s\b")
_CLAUSE_END = re.compile(r"[.,;:!?。、…~\n\r\t]+|[—–]+|\s-+\s")
_CJK = re.compile(r"[\u3400-\u9fff]")
_WRAPPERS = frozenset('"“”‘«»「」『』()[]<>*_#`^')
_GAP = re.compile(r"[^a-z0-9]+")
_SPELT = re.compile(r"s[\W_]*t[\W_]*o[\W_]*p[\W_]*")


def is_stop(text: str) -> bool:
    """Tell whether the whole first clause of a sentence orders a stop, in English or Chinese."""
    plain = _plain(text[:_READ])
    if _SPELT.fullmatch(plain.strip()):  # "s t o p", "S.T.O.P."
        return True
    for clause in _CLAUSE_END.split(plain):
        if _CJK.search(clause):
            compact = "".join(clause.split())
            if not _ZH_ONLY_POLITE.fullmatch(compact):
                return _one_of(_ZH, _ZH_QUITS, clause=compact)
        else:
            words = " ".join(_GAP.sub(" ", clause).split()) if clause.isascii() else clause
            if words and not _EN_ONLY_POLITE.fullmatch(words):
                return _one_of(_EN, _EN_QUITS, clause=words)
    return False


def _one_of(*patterns: re.Pattern[str], clause: str) -> bool:
    return any(pattern.fullmatch(clause) for pattern in patterns)


def _plain(text: str) -> str:
    """Fold width and case, drop what is not seen, turn symbols into spaces."""
    folded = unicodedata.normalize("NFKC", text).casefold().translate(_TRADITIONAL)
    seen = "".join(map(_visible, folded.replace("🛑", " stop ").replace("’", "'")))
    return _LETS.sub("let us", _DONT.sub("do not", seen))


def _visible(char: str) -> str:
    category = unicodedata.category(char)
    if category in {"Cf", "Mn", "Me"}:  # zero-width marks, variation selectors, keycaps
        return ""
    return " " if category in {"So", "Sk"} or char in _WRAPPERS else char
