"""Tell a statement that names a place from an order to go there. Pure; knows words and no grammar.

"The study smells of coffee", 厨房真漂亮: a place is spoken of, and no word sends anybody there. A
bare name ("the kitchen, please") is an order by itself, and so is what answers a question with it.
In doubt a sentence is a statement: a person is then asked, and nothing else.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.motion_guard.mentioned_names import find_places, plain

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.plan import Vocabulary

_SENDS = re.compile(
    r"\b(?:go|drive|ride|come|walk|run|rush|hurry|dash|head|move|roll|scoot|travel|navigat\w*"
    r"|proceed|make (?:your|a|the|my) (?:way|rounds?|tour|trip|detour)|get (?:back|over|to|in|your)"
    r"|visit|swing|stop (?:by|at|in)|drop (?:by|in)|return|take|bring|fetch|carry|deliver|lead"
    r"|guide|escort|accompany|show|follow|meet|greet|welcome|tell|ask|say|announce|call|wake|remind"
    r"|patrol|rounds?|tour|inspect|check\w*|look|see if|find|search|count|scan|watch|monitor"
    r"|explore|observe|survey|wait|stay|stand|park|face|turn|approach|reach|position|place yourself"
    r"|need you|want you|you(?: are|'re) (?:needed|wanted|expected)"
    r"|like you to|love you to|have you|you (?:to|in|at|over)\b|off to|over to"
    r"|let|let's|start|begin|end|finish|try|send|charge|recharge|dock|enter|leave|pop|peek|peep"
    r"|pass by|cross|join|hang out|be (?:at|in|by)|if|then|first|before|after|back|route|via"
    r"|through|to (?:the|my|our|your)|towards?|into|please|mind|make sure|see|seeing"
    r"|(?:would|could|can|will) you|who|what|where|which|how|whether|any|anyone|anybody|rather"
    r"|instead|i (?:mean|meant|said))\b"
    r"|^(?:is|are|do|does|has|have)\b|\?|[吗谁哪几]|什么|多少|有没有|是否"
    r"|我(?:是)?说|改成|换成|应该是"
    r"|[去到进回找查数转跟走巡送拿带接等停站靠绕逛溜]|过来|来一|来趟|^来|开(?:到|去|往|过|回|进|车)"
    r"|看(?!起来|来|上去|过)|瞧|先|再|然后|告诉|通知|问|叫|喊|跑|移动|前往|返|驶|拐|路过|经过"
)
"""Words that may order a way, or ask for a look: a list on the generous side."""
_FILLS = re.compile(
    r"\b(?:the|a|an|my|our|your|please|pls|now|ok|okay|hey|hi|hello|robot|pons|and|or|then|quick"
    r"|quickly|slowly|again|too|also|next|just|um+|uh+|er+|hm+|oh|well|yes|no|right|there|in|at|on"
    r"|by|of|to|kindly|i think|i guess|maybe|perhaps|actually|sorry|instead|not|rather|thanks"
    r"|thank you|i (?:said|mean|meant))\b"
    r"|我说的?|[请吧呢啊呀的了嘛哦嗯那就是不和跟与、里间边上儿]|一下|麻烦|好的|不对|谢谢|现在|马上"
    r"|机器人|[^\w]+"
)
"""What may stand beside a bare name."""
_SAYS_GOOD = re.compile(r"真?好看|真?好吃|好找|看来|看起来|看上去")


def only_states(texts: Sequence[str], vocabulary: Vocabulary) -> bool:
    """Return whether no part of what a person said orders a way, or is a bare name.

    Args:
        texts: order and answers, each without what is denied, told to others or past.
        vocabulary: whose names are no words of their own.
    """
    told = [text for text in texts if text.strip()]
    return bool(told) and not any(
        _SENDS.search(_SAYS_GOOD.sub(" ", text)) or _is_bare(text, vocabulary) for text in told
    )


def _is_bare(text: str, vocabulary: Vocabulary) -> bool:
    text = plain(text)
    for place in reversed(find_places(text, vocabulary)):
        text = f"{text[: place.start]} {text[place.end :]}"
    return not _FILLS.sub("", text)
