"""Own what is said of what the robot has done: "did you find the cup", 找到杯子了吗, 数完了吗.

It is a question or a statement, never an order: nothing is driven or searched for it, and this
brain keeps no record to answer from. Where the robot itself is, it can tell.
"""

from __future__ import annotations

from re import Match

from planner.language.grammar.grammar import about, rule
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.parse_result import Meaning, Problem, Reading, Rule
from planner.language.grammar.small_talk import Topic
from planner.language.grammar.zh.words import SEE, SPOT
from planner.plan import Code

_TELL = r"(?:tell (?:me|us)|say|report|find out|check|let (?:me|us) know|do you know)"
_ASKED = r"(?:how many|how much|what|which|who|whom|whose|whether|if)"
_DONE = (
    r"(?:found|saw|seen|counted|met|visited|noticed|spotted|detected|discovered|followed|reached"
    r"|looked|searched|been|went|gone|drove|driven)"
)

_FOUND = r"(?:看到|看见|见到|瞧见|发现|数到|找到)[了过]"


def _no_order(found: Match[str], reading: Reading) -> Meaning | None:
    """Understand nothing, and offer no drive to a place that is only spoken of.

    Behind another clause it is an order in the past tense: "go there and tell me what you saw".
    """
    if reading.scene.kind:
        return None
    return Problem(Code.NOT_UNDERSTOOD, reading.marked.restore(found[0]))


ENGLISH: tuple[Rule, ...] = (
    rule(
        rf"are you (?:still |already |now )*(?:in|at|near|on|inside|by) (?:the )?{MARK}"
        r"(?: (?:now|already|yet|right now))*",
        about(Topic.WHERE),
    ),
    rule(
        rf"(?:{_TELL} )?{_ASKED}\b.* (?:(?:did|have|had|were) (?:you|we)(?! got\b)"
        rf"|you (?:have |had )?{_DONE})(?: .*)?",
        _no_order,
    ),
    rule(rf"(?:{_TELL} (?:if|whether) )?(?:did|had|are|were) (?:you|we) .*", _no_order),
    rule(rf"(?:{_TELL} (?:if|whether) )?(?:have|had) (?:you|we) (?!seen\b).*", _no_order),
    rule(rf"(?:{_TELL} (?:if|whether) )?(?:have|had) (?:you|we) seen .*{MARK}.*", _no_order),
    rule(rf"{_TELL} (?:if|whether) you (?:have |had )?{_DONE}\b.*", _no_order),
)

CHINESE: tuple[Rule, ...] = (
    rule(
        rf"(?!{SEE}(?![到见]))(?:.*{SPOT}.*{_FOUND}.*|.*{_FOUND}.*{SPOT}.*)",
        _no_order,
    ),
)
