"""Own the words that tell a robot to quit what it is at: "stop looking for the cup", 别跟着我了.

Patterns alone, for the stop lane, after its courtesies and for one whole clause; standard library
only. Quitting is said of searching, counting, following, patrolling and driving, never of waiting:
"stop waiting" begins something. What is quitted may be named in any words, but for a condition or
a place that says when or where to stop ("stop looking when you see it"): a brain is asked about
that. Behind a denial nothing is left to a brain: "don't follow me if …" stops, as the safe side.
"""

from __future__ import annotations

_SEARCHING = (
    r"looking|searching|hunting|seeking|finding|locating|counting|tracking|trailing|following"
    r"|chasing|watching|scanning|observing|monitoring|exploring|inspecting|checking|patroll?ing"
    r"|wandering|roaming|touring|visiting|guiding|leading|escorting|accompanying"
)
_DRIVING = (
    r"moving|driving|going|coming|running|rolling|turning|spinning|navigating|walking|heading"
)
_TO = (
    r"(?:to|towards?|into|after|behind|around|about|through|back|forwards?|backwards?|away|home"
    r"|here|there|left|right|with|along|in circles?)"
)
_NO_FOLLOWER = r"after(?! (?:me|us|him|her|them|it)\b)"
_WHEN = (
    r"when|whenever|if|once|unless|as|while|before|in front|next to|near|beside"
    rf"|{_NO_FOLLOWER}"
)
_NOW = r"(?: (?:and|then|but|because|until|till)\b.*)?"
"""What may follow an order to stop without making it another."""
_REST = rf"(?: (?!(?:and|then|but|because|until|till|{_WHEN})\b)[a-z0-9]+)*{_NOW}"
_ENDING = r"(?:s+t+o+p+|quit|cease|leave off|give up|(?:no more|enough)(?: of| with)?)"
_SEARCH = (
    r"(?:search|hunt|count|patrol|tour|chase|pursuit|exploration|inspection"
    rf"|{_SEARCHING})"
)
_BASE = (
    r"look|search|hunt|seek|find|locate|count|track|trail|follow|chase|watch|scan|observe|monitor"
    r"|explore|inspect|check|patrol|wander|roam|guide|lead|escort|accompany"
    r"|(?:come|go|run|walk) (?:after|behind|with)|keep (?:looking|searching|counting|following)"
)
_DENYING = (
    r"(?:i do not want you to|(?:you )?(?:should|must) ?(?:not|n t)|do not(?: ever)?|never"
    r"|no longer)"
)

_NEARER = (
    r"(?:drive|turn|spin|rotate|roll|come|approach)(?: (?:any|closer|nearer|near|further|on|here|to"
    r"|towards?|up|at|me|us|around|now|again|more|anymore))*"
)
_IT = r"(?:(?:the |this |that )?(?:robot|car|it|thing) (?:from )?)?"

ENGLISH = (
    rf"{_ENDING} {_IT}(?:{_SEARCHING}){_REST}"
    rf"|{_ENDING} (?:{_DRIVING}) {_TO}\b{_REST}"
    rf"|(?:{_ENDING}|cancel|abort|end|pause|abandon|call off|suspend)"
    rf" (?:(?:the|this|that|your|my|all|current|whole) )*{_SEARCH}{_REST}"
    rf"|{_DENYING} (?:{_BASE})(?: .*)?|{_DENYING} {_NEARER}"
    rf"|leave (?:me|us|him|her|them|it) alone{_NOW}"
)

_DO = (
    r"(?:寻找|查找|找|搜|跟|尾随|追|数(?![据学字])|计数|清点|点数|统计|查看|检查|察看|观察|看|盯"
    r"|巡[逻视检查]|探索|转|绕|带路|领路|靠近|靠过来|接近|过来|上前)"
)
_WELL = r"[^,。]{0,3}(?:错|漏|丢|岔)[了啦吧啊]*$|.*[说讲聊]"
"""别跟丢了 is no order to quit, and 别跟他说 no order to this end."""
_ASKS = r".*(?:(?<![好行])(?<!可以)吗|没有?|呢|哪里?|哪儿|什么)$"
_DENYING_ZH = (
    r"(?:别|不要|不许|不准|勿|莫|我(?:不要|不想|不希望)(?:让|叫|要)?)"
    r"(?:你|再|继续|老是?|总是?|一直)*"
)
_ENDING_ZH = (
    r"(?:停止|中止|终止|取消|暂停|结束|放弃)(?:你|现在|当前|这次|本次|继续|的)*"
    r"(?:对[^,。]{1,10}的)?"
)

CHINESE = (
    rf"(?:停(?:下来?|止)?)?{_DENYING_ZH}{_DO}(?!{_WELL})(?!{_ASKS}).*"
    rf"|{_ENDING_ZH}{_DO}(?!{_ASKS}).*"
)
