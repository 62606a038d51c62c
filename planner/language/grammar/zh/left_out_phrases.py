"""Write a round without some rooms as the rooms left: 每个房间转一圈，卧室不用去.

Pure, over a whole Chinese sentence. Laws: the sentence is one round through all rooms and names
what it leaves out, and nothing else; after 除了 "the other rooms" are named, too; no room that it
leaves out stands in the result. Any other exception stays in the sentence, for the vetoes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.grammar.lexicon import MARK, lexicon_of
from planner.language.grammar.sentence_text import normalise

if TYPE_CHECKING:
    from planner.plan import Vocabulary

_NAMES = rf"(?P<out>{MARK}(?:[、,和跟与]{MARK})*)"
_POLITE = r"(?:请|麻烦|帮我|你|给我|替我)*"
_ROOMS = r"(?:其他|其它|别的|剩下的?|其余的?)(?:所有|全部|每一?个|各个)?的?(?:房间|屋子?|地方)?(?:里面?)?"
_HOUSE = (
    r"(?:(?:所有|全部|每一?个|各个|每间|挨个)的?(?:房间|屋子?|地方)?|全屋|全家|屋里|家里)(?:里面?)?"
)
_ALL = r"(?:你|都|全都?|挨个|各|统统|帮我|给我|去|过去)*"
_TOURS = (
    r"(?P<tours>(?:巡逻|巡视|巡查|转|走|逛|跑|巡|绕|去)(?:一?[遍圈下趟轮])?(?:吧|转|走|逛)?"
    r"|(?:检查|查看|看|查|瞧)一?[遍圈轮])"
)
_LOOKS = r"(?:看看|看一看|看一下|看下|瞧瞧|检查一下|检查|查看一下|查看)"
_LOOKED_FOR = rf"(?:{_TOURS}[,]?(?:然后|顺便)?)?(?:(?P<looks>{_LOOKS})(?P<asked>有没有[^,。;找]{{1,12}}|有(?:什么|谁)[^,。;找]{{0,6}})?)?"
_NOT = r"(?:别|不要|不用|不必|甭|不需要|不许)(?:再)?"
_BUT = r"(?:但是?|不过|就|只是|可是)*"
_SKIPS = (
    rf"{_BUT}{_NAMES}(?:那边|那里|里面?)?(?:就|先|你|可以)*{_NOT}(?:进去|进|去|看|查|转|管|到|走|逛)(?:了|它|啦)*"
    rf"|{_BUT}(?:跳过|略过|{_NOT}(?:进去?|去到?|看|查|到)){_NAMES.replace('out', 'out2')}(?:里面?)?了?"
)
_END = r"(?:吧|啊|呀|哦|哈|嘛|呗)*[。.!]*"
_FORMS = (
    re.compile(
        rf"{_POLITE}除(?:了|开|去){_NAMES}(?:以外|之外|外)?[,]?{_POLITE}(?:把)?{_ROOMS}(?=都|全|挨个|各|统统){_ALL}"
        rf"{_LOOKED_FOR}{_END}"
    ),
    re.compile(
        rf"{_POLITE}(?:[把在去到])?{_HOUSE}{_ALL}{_LOOKED_FOR}{_END}[,。;](?:{_SKIPS}){_END}"
    ),
)


def without_left_out_rooms(text: str, vocabulary: Vocabulary) -> str:
    """Return a round through all rooms but some as the list of those that are left."""
    if not has_chinese(text) or re.search(r"除|跳过|略过|[别甭]|不[要用必需许]", text) is None:
        return text
    marked = lexicon_of(vocabulary).mark(normalise(text))
    found = next((m for form in _FORMS if (m := form.fullmatch(marked.text)) is not None), None)
    if found is None or not (found["tours"] or found["looks"]):
        return text
    names = found["out"] or found.groupdict().get("out2") or ""
    mentions = [marked.mention(mark) for mark in re.findall(MARK, names)]
    rooms = {entry.id: entry.name.zh for entry in vocabulary.entries if entry.kind == "room"}
    out = {mention.ids[0] for mention in mentions if len(mention.ids) == 1}
    left = [name for room, name in rooms.items() if room not in out]
    if len(out) != len(mentions) or not out <= set(rooms) or not left:
        return text
    listed = "、".join(left)
    if found["looks"] is None and not re.match(r"[看查检瞧]", found["tours"] or ""):
        return f"巡逻{listed}"
    return f"去{listed}看看{found['asked'] or ''}"
