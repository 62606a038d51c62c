"""Turn what a model wrote into a plan, or say why it is none. Trusts nothing in it. Pure.

A bare step, a bare list of steps and a place's exact name in either language are taken for what
they are; nothing else is mended. Whatever a reply holds, the result is a plan of the closed
vocabulary or a list of reasons that the model can read.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from math import radians
from typing import Any, TypeGuard

from pydantic import ValidationError

from planner.brain.endpoint.order_proposal import propose_order
from planner.brain.endpoint.reply_object import NoObject, read_reply
from planner.brain.schema import CLARIFY_CODES, EVIDENCE, KINDS, MOST_DEG, REFUSE_CODES
from planner.language.folding import fold_words
from planner.language.yes_no import consents
from planner.plan import (
    MAX_DEPTH,
    MAX_STEPS,
    PLAN,
    RUNNABLE,
    STEPLESS,
    TOOL_CALLS,
    AnswerPlan,
    Clarify,
    PlanRole,
    Refuse,
    StepPlan,
    UseTool,
    Vocabulary,
    check_plan,
    list_nodes,
)

MAX_TEXT = 600
MAX_OPTIONS = 8
MAX_REASONS = 6
_KEYS = {
    "plan": {"steps", "does", "pace"},
    "answer": {"text", "en", "zh"},
    "clarify": {"code", "text", "en", "zh", "options"},
    "refuse": {"code", "text", "en", "zh"},
}
_CODES = {"clarify": CLARIFY_CODES, "refuse": REFUSE_CODES}
# Marks that turn or hide text, and what is no text at all, have no place in words for a person.
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn"})

Planned = StepPlan | AnswerPlan | Clarify | Refuse


@dataclass(frozen=True, slots=True)
class Unusable:
    """Hold why a reply is no plan, for the repair turn."""

    reasons: tuple[str, ...]
    code: str = "bad_plan"
    """One of ``planner.brain.model_error_codes``."""

    def __str__(self) -> str:
        return "; ".join(self.reasons)


def judge(
    text: str, vocabulary: Vocabulary, runnable: frozenset[str] = RUNNABLE
) -> Planned | Unusable:
    """Return the plan that a reply is, or why it is none.

    A plan that only the robot's own lack makes impossible (no camera, no arm) is returned as it is:
    the mission refuses it with the right code.
    """
    try:
        shaped = _reshape(read_reply(text), vocabulary)
    except NoObject as why:
        return Unusable((str(why),))
    except RecursionError:  # two deep objects were compared
        return Unusable(("the reply's JSON is too deep",))
    if isinstance(shaped, Unusable):
        return shaped
    try:
        plan = PLAN.validate_python(shaped)
    except ValidationError as wrong:
        errors = wrong.errors(include_url=False)[:MAX_REASONS]
        of_places = any(_PLACES.intersection(map(str, error["loc"])) for error in errors)
        known = (_known_places(vocabulary),) if of_places else ()
        return Unusable((*map(_describe_error, errors), *known))
    if (wrong_calls := tuple(_find_wrong_calls(plan, vocabulary))) and runnable >= TOOL_CALLS:
        return Unusable(wrong_calls[:MAX_REASONS])
    rejection = check_plan(plan, vocabulary, runnable)
    if rejection is not None and rejection.repairable:
        told = [f"{_at(r.step)}{r.code.value}: {clean(r.what)[:80]}" for r in rejection.reasons]
        return Unusable((*told[:MAX_REASONS], _known_places(vocabulary)))
    return plan


def _find_wrong_calls(plan: Planned, vocabulary: Vocabulary) -> Iterator[str]:
    """Yield why a call of a tool is none: it is not offered, or not given what it needs."""
    for node in list_nodes(plan.steps) if isinstance(plan, StepPlan) else ():
        if isinstance(call := node.step, UseTool):
            tool = vocabulary.tool(call.tool)
            if tool is None:
                known = ", ".join(each.name for each in vocabulary.tools)
                yield f"no tool {clean(call.tool)[:80]}; known: {known[:400]}"
            elif missing := tool.find_missing(call.arguments):
                yield f"{tool.name} needs {', '.join(missing)}"


def _known_places(vocabulary: Vocabulary) -> str:
    return f"known places: {', '.join(list(vocabulary.by_id)[:40]) or 'none'}"


def _reshape(reply: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any] | Unusable:
    """Return the reply in the plan's own shape; fields that do not belong there are reasons."""
    kind = reply.get("kind")
    if not isinstance(kind, str) or kind not in KINDS:
        return Unusable((f"kind must be one of {', '.join(KINDS)}",))
    filled = {k: v for k, v in reply.items() if k != "kind" and v not in (None, "", [])}
    extra = sorted(clean(str(key))[:40] for key in filled.keys() - _KEYS[kind])
    if extra:
        takes, found = ", ".join(sorted(_KEYS[kind])), ", ".join(extra[:MAX_REASONS])
        return Unusable((f"{kind} takes {takes} and not: {found}",))
    listed = filled.get("steps")
    if kind == "plan" and isinstance(listed, list):
        proposed = propose_order(listed)
        if proposed is not None:
            return Unusable((proposed,)) if isinstance(proposed, str) else proposed.model_dump()
    if kind == "plan":
        steps = resolve_places(filled.get("steps"), vocabulary)
        shaped = _steps(steps, filled.get("does", PlanRole.NEW.value))
        paced = isinstance(shaped, dict) and "pace" in filled
        return {**shaped, "pace": filled["pace"]} if paced and isinstance(shaped, dict) else shaped
    return _words(kind, filled, vocabulary)


def _steps(steps: object, does: object) -> dict[str, Any] | Unusable:
    if does not in [role.value for role in PlanRole]:
        return Unusable((f"does must be one of {', '.join(role.value for role in PlanRole)}",))
    if does in STEPLESS and steps is None:
        steps = []
    if not isinstance(steps, list) or not all(isinstance(step, dict) for step in steps):
        return Unusable(("steps must be a list of 1 or more objects",))
    if len(steps) > MAX_STEPS:
        return Unusable((f"{len(steps)} steps; at most {MAX_STEPS}",))
    asked_by = tuple(_evidence(steps))
    trimmed = [trim_step(step) for step in steps]
    if any(not abs(deg) <= MOST_DEG for deg in _degrees_left(trimmed)):
        return Unusable((f"angle_deg must be from -{MOST_DEG} to {MOST_DEG}",))
    blank = next(_blanks(trimmed), None)
    if blank is not None:  # the prompt's own "…", copied
        return Unusable((f"{blank} needs words of your own",))
    shaped = {"kind": "plan", "does": does, "steps": trimmed}
    return shaped | ({"asked_by": asked_by} if any(asked_by) else {})


_HELD = ("when", "then", "otherwise", "steps", "on_failure", "until")
"""Fields that hold steps, in the order of ``planner.plan.tree``."""


def _evidence(steps: list[Any], deep: int = 0) -> Iterator[str]:
    """Yield the words that are quoted for each step, by the row of ``list_nodes``."""
    for step in steps if deep <= MAX_DEPTH else ():
        named = {_NAMES.get(k, k): v for k, v in step.items()} if isinstance(step, dict) else {}
        quoted = named.get(EVIDENCE)
        yield clean(quoted) if isinstance(quoted, str) else ""
        for name in _HELD:
            held = named.get(name)
            yield from _evidence(
                held if isinstance(held, list) else [held] if held else [], deep + 1
            )


_NAMES = {"else": "otherwise", "else_": "otherwise", "do": "steps"}
"""What models write for fields that hold steps."""


def trim_step(step: dict[str, Any], deep: int = 0) -> dict[str, Any]:
    """Drop fields that a grammar made the model fill with nothing; clean its words."""
    filled = {k: v for k, v in step.items() if k != EVIDENCE and v not in (None, "", [], {})}
    named = {_NAMES.get(k, k): v for k, v in filled.items()}
    return {k: _trim(k, v, deep) for k, v in _in_radians(named).items()}


def _in_radians(step: dict[str, Any]) -> dict[str, Any]:
    """Return a step with its angle in radians, as the plan keeps it; models are told degrees."""
    deg = step.get("angle_deg")
    if "angle_rad" in step or not _is_number(deg) or not abs(deg) <= MOST_DEG:
        return step
    others = {k: v for k, v in step.items() if k != "angle_deg"}
    return others | {"angle_rad": radians(deg)}


def _degrees_left(value: Any, deep: int = 0) -> Iterator[float]:
    """Yield the angles in degrees that no plan takes."""
    if deep > 2 * MAX_DEPTH + 2:  # too deep anyhow: the plan's own check says so
        return
    if isinstance(value, dict):
        if _is_number(value.get("angle_deg")):
            yield value["angle_deg"]
        value = list(value.values())
    for inner in value if isinstance(value, list) else ():
        yield from _degrees_left(inner, deep + 1)


def _is_number(value: Any) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _trim(name: str, value: Any, deep: int) -> Any:
    if name in ("text", "question") and isinstance(value, str):
        return clean(value)
    if deep > MAX_DEPTH:  # too deep anyhow: the plan's own check says so
        return value
    if isinstance(value, dict):
        return trim_step(value, deep + 1)
    if isinstance(value, list):
        return [trim_step(v, deep + 1) if isinstance(v, dict) else v for v in value]
    return value


_PLACES = frozenset({"place", "places"})


def resolve_places(value: Any, vocabulary: Vocabulary, name: str = "", deep: int = 0) -> Any:
    """Return steps in which a place's exact name or alias, in either language, is its id.

    A name of several places, or of none, stays as it was written and is judged so.
    """
    if deep > 2 * MAX_DEPTH + 2:  # too deep anyhow: the plan's own check says so
        return value
    if isinstance(value, dict):
        value = _in_row(value, vocabulary)
        return {k: resolve_places(v, vocabulary, str(k), deep + 1) for k, v in value.items()}
    if isinstance(value, list):
        return [resolve_places(each, vocabulary, name, deep + 1) for each in value]
    if name not in _PLACES or not isinstance(value, str) or value in vocabulary:
        return value
    said = fold_words(value[:MAX_TEXT]).strip().removeprefix("the ")
    found = [e.id for e in vocabulary.entries if said in map(fold_words, e.spellings)]
    return found[0] if len(found) == 1 else value


def _in_row(step: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    """Return a call whose arguments are named, as models know them, with them in their row."""
    given = step.get("arguments")
    tool = vocabulary.tool(str(step.get("tool"))) if isinstance(given, dict) else None
    if tool is None or not isinstance(given, dict):
        return step
    known = [each.name for each in tool.parameters]
    return step if given.keys() - set(known) else {**step, "arguments": [*map(given.get, known)]}


def _blanks(value: Any, name: str = "steps", deep: int = 0) -> Iterator[str]:
    """Yield the names of fields whose text says nothing."""
    if isinstance(value, str):
        is_left_out = name == "arguments" and not value  # as the prompt says of a tool's "?"
        if says_nothing(value) and not is_left_out:
            yield clean(name)[:40]
        return
    if deep > 2 * MAX_DEPTH + 2:  # too deep anyhow: the plan's own check says so
        return
    named: list[tuple[str, Any]] = []
    if isinstance(value, dict):
        named = [(str(key), each) for key, each in value.items()]
    elif isinstance(value, list):
        named = [(name, each) for each in value]
    for inner, each in named:
        yield from _blanks(each, inner, deep + 1)


def says_nothing(text: str) -> bool:
    """Tell whether a text has neither letter, digit nor symbol: "…" is the prompt's own blank."""
    return not any(unicodedata.category(char)[0] in "LNS" for char in text)


def _words(kind: str, filled: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any] | Unusable:
    # One language is asked for; the two of an older prompt are still taken.
    one = filled.get("text") or filled.get("en") or filled.get("zh")
    en, zh = filled.get("en", one), filled.get("zh", one)
    if not isinstance(en, str) or not isinstance(zh, str):
        return Unusable((f"{kind} needs a text",))
    said = {"en": _short(en), "zh": _short(zh)}
    if says_nothing(said["en"]) or says_nothing(said["zh"]):
        return Unusable((f"{kind} needs words of your own in text",))
    if kind == "answer":
        return {"kind": kind, "text": said}
    allowed = [code.value for code in _CODES[kind]]
    code = filled.get("code")
    if code not in allowed:
        return Unusable((f"the code of {kind} must be one of {', '.join(allowed)}",))
    if kind == "refuse":
        return {"kind": kind, "code": code, "reason": said}
    options = filled.get("options", [])
    if not isinstance(options, list) or not all(isinstance(each, str) for each in options):
        return Unusable(("options must be a list of texts",))
    short = [_short(each) for each in options[:MAX_OPTIONS]]
    # "Yes" orders nothing: who says it answers the question itself, which a model then reads.
    words = [each for each in short if not says_nothing(each) and consents(each) is None]
    buttons = [{"label": {"en": each, "zh": each}, "text": each} for each in words]
    return {"kind": kind, "code": code, "question": said, "options": buttons}


def clean(text: str) -> str:
    """Return text that a person can be shown: no control, hidden, turning or broken characters."""
    plain = " ".join(text[: 4 * MAX_TEXT].split())
    return "".join(char for char in plain if unicodedata.category(char) not in _UNSEEN)


def _short(text: str) -> str:
    plain = clean(text)
    return plain if len(plain) <= MAX_TEXT else plain[: MAX_TEXT - 1] + "…"


def _at(step: int | None) -> str:
    return "" if step is None else f"step {step + 1}: "


def _describe_error(error: Any) -> str:
    """Describe a pydantic error by place and kind; the value itself is not repeated."""
    return f"{'.'.join(clean(str(part))[:40] for part in error['loc'][:6])}: {error['msg'][:160]}"
