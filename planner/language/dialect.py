"""Write the words of Chinese dialects and of hurried speech as the standard words they stand for.

People from the north say 瞅瞅, 今儿 and 上书房去, people from the south 讲一声 and 一个钟头.
For each there is one standard word that means the same; nothing is added, and no word is taken away
but final particles.
The text from the first words for somebody else on ("tell Grandma …"), and all quoted text, stay as
they were said. Denials stay denials (甭 is 不用). Pure, and stable: twice changes nothing more.
"""

from __future__ import annotations

import re

from planner.language.folding import fold, has_chinese

_BEGIN = r"(?:^|(?<=[,.!?;。，！？；]))"
_END = r"(?=$|[,.!?;。，！？；])"
_LEAD = r"(?P<lead>(?:请|你|您|麻烦|劳驾|先|再|就|快|那|帮我|给我|赶紧|现在|然后|我让你)*)"
_WORDS = tuple(
    (re.compile(pattern), plain)
    for pattern, plain in (
        # looking
        (r"(?:瞅|瞧|瞄)(?:一瞅|一瞧|瞅|瞧|一眼|一下|两眼|上一眼|一瞄)", "看看"),
        (r"看看(?:去|看)(?=[,，。!！?？]|$)", "看看"),
        (r"[瞅瞧]见", "看见"),
        (r"[瞅瞧](?=着|到|完)", "看"),
        (r"[瞅瞧](?!不)", "看"),
        # time
        (r"(?P<d>[今明昨后])儿个?", r"\g<d>天"),
        (r"这会儿?子?(?=[^,，。]*[?？没吗])", "现在"),
        (r"钟头", "小时"),
        (rf"{_BEGIN}往后(?=每|天天|只要|一[^些点下步]|有)", "以后"),
        # people and things
        (r"咱俩|咱们俩?|咱", "我们"),
        (r"俺们?", "我"),
        (r"啥(?!子)", "什么"),
        (r"咋(?:样|个)?(?=了|回)", "怎么"),
        (r"(?P<w>[点块圈趟下边活样事空玩道门])儿(?!子|童|媳|女)", r"\g<w>"),
        (r"旮旯", "角落"),
        # doing
        (r"甭", "不用"),
        (r"搁(?=[这那])", "在"),
        (r"搁", "放"),
        (r"(?<!时)候着", "等着"),
        (r"(?:说|讲)一?声(?=[,，。]|$)", "说一声"),
        (r"讲(?=一声|一句|给我)", "说"),
        (r"(?<=[跟和向给对]我)讲(?:讲)?", "说"),
        (rf"{_BEGIN}{_LEAD}上(?![面边午次回班学床来下]|厕所|一)(?=[^,，。]{{1,5}})", r"\g<lead>去"),
        (r"去{2,}", "去"),
        (r"(?:挨(?:个|着)?|每一?间|满)(?:房间|房|屋子?)|一间房?间?一间房?间?|一间间", "每个房间"),
        (rf"{_BEGIN}(?:往|向|朝)?(?:倒车[,，]?)+", "后退"),
        (r"(?:往|向|朝)?(?P<s>[左右])(?:边|手边|侧|手)转", r"向\g<s>转"),
        (r"转过[去来][,，]?(?:脸|正脸|头|正面)?(?:冲|朝|对)着?(?=[^,，。]{1,5})", "转过去对着"),
        # final particles: they carry a mood and no meaning
        (rf"(?<=[人了着天呢个点遍下看找])哪{_END}", ""),
        (rf"(?:呗|哈|咧|嘞|噻|哟|喽|咯|呐|哩){_END}", ""),
        (rf"(?<=[了着的下去来遍看数找没])(?:啊|呀|哦|噢|啦|嘛){_END}", ""),
    )
)  # fmt: skip
_QUOTED = re.compile(r"(\"[^\"]*\"|“[^”]*”|「[^」]*」|『[^』]*』)")
_SPEECH = re.compile(
    r"[\"“”「」『』]|(?:告诉|提醒|通知|转告|催)(?!我)|[问喊叫念]|回答|带(?:个|句)话"
    r"|(?:[跟和向给对](?!我)[^,，。]{1,8}|一声|一句|大声|就|声)[说讲]"
)
"""Where words for somebody else may begin."""
_MOST_PASSES = 8
_MAY_QUOTE = ("喊", "叫", "说", "讲", "念")
"""What these speak may stand in quotes, and orders behind it."""


def in_standard_words(text: str) -> str:
    """Return a Chinese text in standard words up to where it speaks to somebody.

    Any other text is returned as it is.

    Args:
        text: what was said, as it was written.
    """
    if not has_chinese(text):
        return text
    said = fold(text)
    parts = _QUOTED.split(said)  # every second one is quoted
    for number in range(0, len(parts), 2):
        found = _SPEECH.search(parts[number])
        start = found.start() if found is not None else len(parts[number])
        parts[number] = _standard(parts[number][:start]) + parts[number][start:]
        if found is not None and found[0] not in _MAY_QUOTE:
            break
    plain = "".join(parts)
    return text if plain == said else plain


def _standard(words: str) -> str:
    for _ in range(_MOST_PASSES):
        before = words
        for pattern, standard in _WORDS:
            words = pattern.sub(standard, words)
        if words == before:
            break
    return words
