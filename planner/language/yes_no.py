"""Tell a plain yes and a plain no from all other answers, in English and Chinese. Pure.

For questions upon whose yes something moves: every word must say it, or be mere courtesy or the
noise of speech ("um", 嗯). What comes with a condition, a question or both words is neither, and so
is what negates twice (不去不行) or may mean "enough" (好了). Orders to stop and to take the goal
back never come here: they are obeyed beside the question (planner/language/commands).
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from planner.language.folding import fold, has_chinese

if TYPE_CHECKING:
    from collections.abc import Sequence

_READ = 80
"""Characters; a longer answer is no plain one."""
_CLAUSE_END = re.compile(r"[.,;:!~…。、—–\"“”「」]+")
_MARKS = str.maketrans({"’": "'", "-": " ", "欸": "诶"})

YES, NO, COURTESY, END, NEITHER = "yes", "no", "courtesy", "end", "neither"

_ENGLISH = {
    YES: "y|yes|yeah|yep|yup|yea|ya|yah|aye|ok|okay|okey|okey dokey|k|kk|sure|sure thing"
    "|of course|certainly|absolutely|definitely|indeed|affirmative|correct|exactly"
    "|that's right|that is right|that's correct|that is correct|that's good|that's it"
    "|that's the one|that works|all right|alright|fine|fine by me|fine with me|okay by me"
    "|okay with me|ok by me|ok with me|sounds good|sounds great|sounds fine|good idea"
    "|great idea|works for me|by all means|go|go ahead|go on|go for it|go there|drive"
    "|drive there|carry on|continue|proceed|do|do it|do that|do so|do this|you may"
    "|you can|you should|i agree|agreed|i do|i would|i would like that|i'd like that"
    "|i want that|i want you to|i confirm|confirm|confirmed|confirm it|i approve|approve"
    "|approved|accept|accepted|granted|permission granted|i'm sure|i am sure|it is"
    "|it does|why not|no problem|not a problem|make it so|let's go|let us go|let's do it"
    "|let's do that|very well|very much|with pleasure|gladly|mhm|mm hm|mm hmm|uh huh"
    "|roger|roger that|be my guest|come|come here|come over|that one|go to it|i insist"
    "|sounds good to me|that would be great|that would be nice|that would be good"
    "|that'd be great|i'd love that|for sure|no objection|no objections|go right ahead"
    "|you bet|yessir|totally|okie dokie",
    NO: "n|no|nope|nah|naw|nay|never|never ever|no way|no thanks|no thank you|not now|not yet"
    "|not there|not today|not at all|not really|not this time|not that|not that one"
    "|not necessary|not needed|not right now|no need|no need to|don't|do not|dont"
    "|don't go|do not go|don't go there|do not go there|don't do it|do not do it"
    "|don't do that|do not do that|don't do this|don't drive|do not drive"
    "|don't drive there|do not drive there|don't come|do not come|don't bother|i don't"
    "|i do not|i don't want that|i do not want that|i don't want you to"
    "|i do not want you to|i don't want to|i don't want it|i don't think so"
    "|i do not think so|i'd rather not|i would rather not|rather not|better not"
    "|i'd rather you didn't|i would rather you did not|of course not|certainly not"
    "|absolutely not|definitely not|negative|wrong|incorrect|that's wrong|that is wrong"
    "|that's not right|that is not right|that's not it|that is not it"
    "|that's not what i meant|that's not what i want|it's not|it is not|it isn't"
    "|it doesn't|refuse|i refuse|refused|decline|declined|i decline|reject|rejected"
    "|denied|i disagree|never mind|forget it|forget about it|skip it|leave it|uh uh"
    "|nuh uh|no chance|not a chance|not happening|stay|stay here|stay there|you may not"
    "|you can't|you cannot|you must not|you shouldn't|you should not|by no means|no deal"
    "|i said no|maybe not|probably not|maybe later|later|another time|next time"
    "|some other time|no sir|none|none of them|none of these|none of those|neither"
    "|neither of them|neither of these|neither of those",
    COURTESY: "please|pls|plz|thanks|thank you|thank you very much|thanks a lot|many thanks|cheers"
    "|robot|pons|um|umm|uh|uhh|er|erm|ah|oh|well|hey|hello|hi|so|then|now|right now|just"
    "|actually|i said|great|good|perfect|cool|nice|lovely|super|right|sir|mate|buddy|dear"
    "|my friend|ma'am|madam|sorry|that's fine|that is fine|that's ok|that's okay"
    "|it's fine|it's ok|it's okay|it is fine|no worries|for me|kindly|there",
    NEITHER: "yeah right",
}
_CHINESE = {
    YES: "是|是的|对|好|行|可以|可行|没问题|没有问题|没错|不错的主意|同意|我同意|批准|允许"
    "|准许|确认|确定|当然|当然可以|当然好|必须的|去|过去|开过去|去那里|去那边|要|要去"
    "|要的|想要|需要|愿意|走吧|出发|开始|来吧|开吧|继续|照做|执行|就这样|就这么办"
    "|就这么做|这样可以|这样好|这样行|嗯嗯|嗯哪|得嘞|妥|成|说得对|正是|没意见|就是它"
    "|就是这个|就是那个|就它|这样|照办|动身|没毛病|听你的|准了|答应|我答应|乐意|好主意"
    "|去看看|过去看看|帮我去|那帮我去|ok|okay|yes|yeah|yep|sure|好哇",
    NO: "不谢谢|不谢谢你|不谢谢您|不|不是|不对|不要|不用|不行|不可以|不能|不好|不同意|不去"
    "|不过去|不必|不需要|不想|不想要|不愿意|不许|不准|不允许|不确认|不了|不用了|不要了"
    "|不去了|不必了|不需要了|不过去了|不想去|不想了|不要去|不要过去|不要开过去|不用去"
    "|不用过去|不能去|不可以去|别|别去|别去了|别过去|别开过去|别了|别去那里|甭|甭去"
    "|甭去了|没必要|没门|没有|没|还没|还没有|还不行|还不要|先不要|先不用|先不用了|先不去"
    "|先不|先别|先别去|暂时不用|暂时不要|暂时别|当然不|当然不行|当然不要|当然不可以"
    "|绝对不行|绝对不要|千万别|千万不要|否|否定|错|错了|拒绝|我拒绝|反对|算了|免了|唔好"
    "|唔要|唔使|唔得|唔系|冇|我说不|不是这个|不是那个|不是它|不用去了|不用过去了|不太好"
    "|不太想|改天|下次|以后再说|no|nope|都不是|都不对|都不要|两个都不是|两个都不对|两个都不要",
    COURTESY: "嗯|呃|额|哦|噢|喔|啊|哎|诶|嘿|喂|那个|那|那就|就|请|您|你|麻烦|麻烦你|麻烦您|麻烦了"
    "|麻烦你了|麻烦您了|还是|谢谢|谢谢你|谢谢您|多谢|感谢|谢了|辛苦|辛苦了|辛苦你了|拜托"
    "|拜托了|机器人|小车|现在|马上|赶紧|快|我|我说|please|thanks|robot|pons|你就",
    END: "的|吧|呀|哇|啦|哈|哒|滴|嘞|咧|哟|咯|喽",
    NEITHER: "我去|你好|您好|我好|你是|我是|你要|快要|快好|马上好|别的|不错|不谢|要是|可不是"
    "|不得不|不好说|不好意思|去你|别人",
}
"""了 ends no yes: 好了 and 行了 mean "enough". 嘛 and 呢 end none either: they ask."""


class _Word(NamedTuple):
    """Hold one word or phrase of an answer, and its role there."""

    text: str
    kind: str


class _Reader:
    """Cut clauses of one language into known words, the longest first: linear in their length."""

    def __init__(self, words: dict[str, str], gap: str) -> None:
        """Take the words of each kind and the joints between two of them."""
        written = {word: kind for kind, text in words.items() for word in text.split("|")}
        hasty = {word.replace("'", ""): kind for word, kind in written.items()}
        self._kinds = {**hasty, **written}
        longest = sorted(self._kinds, key=len, reverse=True)
        self._word = re.compile("|".join(map(re.escape, longest)))
        self._gap = gap

    def words(self, clause: str) -> list[_Word] | None:
        """Return the words of a clause; None where any of it is no known word."""
        found: list[_Word] = []
        at = 0
        while at < len(clause):
            word = self._longest(clause, at)
            if word is None:
                return None
            found.append(_Word(word, self._kinds[word]))
            at += len(word) + len(self._gap)
        return found

    def _longest(self, clause: str, at: int) -> str | None:
        if not self._gap:
            match = self._word.match(clause, at)
            return match[0] if match is not None else None
        parts = clause[at:].split(self._gap, 6)[:6]
        tries = (self._gap.join(parts[:count]) for count in range(len(parts), 0, -1))
        return next((words for words in tries if words in self._kinds), None)


_READ_ENGLISH, _READ_CHINESE = _Reader(_ENGLISH, " "), _Reader(_CHINESE, "")


def consents(answer: str) -> bool | None:
    """Return True for a plain yes, False for a plain no, None for everything else."""
    if not len(answer) <= _READ:
        return None
    folded = fold(answer).translate(_MARKS)
    said: set[str] = set()
    for clause in _CLAUSE_END.split(folded):
        words = _words(clause)
        if words is None or not _sound(words):
            return None
        said.update(word.kind for word in words)
    meanings = said & {YES, NO}
    return meanings == {YES} if len(meanings) == 1 and NEITHER not in said else None


def _words(clause: str) -> list[_Word] | None:
    if has_chinese(clause):
        return _READ_CHINESE.words("".join(clause.split()))
    return _READ_ENGLISH.words(" ".join(clause.split()))


def _sound(words: Sequence[_Word]) -> bool:
    """Tell whether words that each mean yes or no mean it side by side, too."""
    before: _Word | None = None
    for word in words:
        if word.kind == END and before is None:
            return False
        if word.kind not in (YES, NO):
            continue
        if before is not None and word.text == "是" != before.text[:1]:  # 可以是, 好是
            return False
        if before is not None and {word.kind, before.kind} == {NO} and has_chinese(word.text):
            stutters = word.text.startswith(before.text) or before.text.endswith(word.text)
            if not stutters:  # 不不要 does; 不去不行 negates twice
                return False
        before = word
    return True
