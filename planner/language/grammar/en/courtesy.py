"""Own the English words that look like a condition or a speed and are none: courtesy, a count.

They are taken away, or written plainly, before anybody asks what a sentence hangs on.
"""

from __future__ import annotations

from planner.language.grammar.everyday import table
from planner.language.grammar.lexicon import MARK

_PLACE = rf"(?:(?:the|a|my|our|your|this|that) )?{MARK}"
_END = r"(?=$|[,.!?;])"

_AND_ON = r"(?=$|[,.!;]|,? (?:and|then)(?: then)? (?!(?:you|i|we|he|she|it|they|there|that|the|my|our)\b))"
"""Behind "once" it says how often: no clause begins that the order would hang on."""

COURTESY = table(
    (r"[, ]+(?:and |but )?(?:nice and slow|(?:go |take it )(?:nice and )?slow(?:ly)?|at a slow pace"
     r"|nice and (?:gently|easy))(?=[.!]*$)", " slowly"),
    (r"(?P<l>\b(?:met(?:re|er)s?|m|cm|centimet(?:re|er)s?|feet|foot|degrees?|minutes?|mins?|seconds?|secs?))"
     r" or (?:so|thereabouts)\b", r"\g<l>"),
    (r"\b(?P<a>a|another|one) (?:quick|swift|speedy) (?=(?:little )?(?:lap|round|rounds|tour|sweep|circuit"
     r"|patrol|look|peek|peep|glance|check|search|scan|count|nosy|gander)\b)", r"\g<a> "),
    (rf"\b(?:spin|turn|twirl|rotate|whirl)(?: yourself)?(?: a?round)? once{_AND_ON}", "turn a full circle"),
    (rf"\b(?:have a |take a )?look (?:a?round|about) once{_AND_ON}", "look around"),
    (r"[, ]+(?:and )?while you are (?:at it|there|in there|about it)[, ]+(?:please |also |can you |could you )*"
     r"(?=(?:check|look|see|find|count|tell|have|go)\b)", ", and "),
    (rf"(?:^|,) ?if you(?: would|'d| could)? be so (?:kind|good)(?: as to)?{_END}", " please"),
    (rf"(?:^|,)? ?if (?:you do not mind|you would not mind|you please|you would|you could|you may"
     rf"|you can|you like|that is ok(?:ay)?|possible|it is not too much trouble){_END}", ""),
    (r"(?:^|,)? ?when(?:ever)? you(?: have| get|'ve got| have got)? (?:a|one|the|some|any) (?:moment"
     rf"|minute|sec|second|chance|time){_END}", ""),
    (r"^if (?:it is|that is) not (?:too much|any|a) (?:trouble|bother),? ", ""),
    (rf"(?:^|,)? ?when(?:ever)? you are ready{_END}", ""),
    (r"^when(?:ever)? you are ready,? ", ""),
    (rf"\b(?:stay|wait|remain|stand)(?: right)? (?:by|at|in|near|next to) (?P<p>{_PLACE}) (?:until|till)"
     r" (?:i(?:'m| am)? (?:come |am |get )?(?:back|return|come|here)|i(?:'m| am) back)(?: again)?",
     r"go to \g<p> and wait for somebody"),
    (r"^why (?:do not|don't) you (?:just )?(?=(?:go|come|drive|look|find|have|take|check)\b)", ""),
    (r"^(?:it(?: would|'d) be (?:so |very |really )?(?:lovely|great|nice|good|kind|wonderful|helpful)"
     r"|i(?: would|'d) (?:be (?:so |very )?(?:grateful|glad|happy|pleased)|appreciate it|feel better"
     r"|feel safer))(?: of you)? if you(?: could| would|'d)? (?=[a-z])", ""),
)  # fmt: skip
"""Conditions that are none."""
