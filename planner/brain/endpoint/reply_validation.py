"""Turn a model's flat reply into a plan, or say why it is none. Trusts nothing in it.

The reply is data: whatever it holds, the result is a plan of the closed vocabulary or a list of
reasons that the model can read. Pure.
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from planner.brain.endpoint.json_extraction import NoObject, one_object
from planner.brain.schema import CLARIFY_CODES, KINDS, REFUSE_CODES
from planner.plan import (
    MAX_STEPS,
    PLAN,
    RUNNABLE,
    Answer,
    Clarify,
    Refuse,
    StepPlan,
    Vocabulary,
    check_plan,
)

MAX_TEXT = 600
MAX_OPTIONS = 8
MAX_REASONS = 6
_KEYS = {
    "plan": {"steps"},
    "answer": {"en", "zh"},
    "clarify": {"code", "en", "zh", "options"},
    "refuse": {"code", "en", "zh"},
}
_CODES = {"clarify": CLARIFY_CODES, "refuse": REFUSE_CODES}
# Marks that turn or hide text, and what is no text at all, have no place in words for a person.
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn"})

Planned = StepPlan | Answer | Clarify | Refuse


@dataclass(frozen=True, slots=True)
class Unusable:
    """Hold why a reply is no plan, for the repair turn."""

    reasons: tuple[str, ...]

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
        shaped = _shaped(one_object(text), vocabulary)
    except NoObject as why:
        return Unusable((str(why),))
    except RecursionError:  # two deep objects were compared
        return Unusable(("the reply's JSON is too deep",))
    if isinstance(shaped, Unusable):
        return shaped
    try:
        plan = PLAN.validate_python(shaped)
    except ValidationError as wrong:
        return Unusable(tuple(map(_told, wrong.errors(include_url=False)[:MAX_REASONS])))
    rejection = check_plan(plan, vocabulary, runnable)
    if rejection is not None and rejection.repairable:
        known = ", ".join(list(vocabulary.by_id)[:40]) or "none"
        told = [f"{_at(r.step)}{r.code.value}: {clean(r.what)[:80]}" for r in rejection.reasons]
        return Unusable((*told[:MAX_REASONS], f"known places: {known}"))
    return plan


def _shaped(reply: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any] | Unusable:
    """Return the reply in the plan's own shape; what does not belong there is a reason."""
    kind = reply.get("kind")
    if not isinstance(kind, str) or kind not in KINDS:
        return Unusable((f"kind must be one of {', '.join(KINDS)}",))
    filled = {k: v for k, v in reply.items() if k != "kind" and v not in (None, "", [])}
    extra = sorted(clean(str(key))[:40] for key in filled.keys() - _KEYS[kind])
    if extra:
        takes, found = ", ".join(sorted(_KEYS[kind])), ", ".join(extra[:MAX_REASONS])
        return Unusable((f"{kind} takes {takes} and not: {found}",))
    if kind == "plan":
        return _steps(filled.get("steps"))
    return _words(kind, filled, vocabulary)


def _steps(steps: object) -> dict[str, Any] | Unusable:
    if not isinstance(steps, list) or not all(isinstance(step, dict) for step in steps):
        return Unusable(("steps must be a list of 1 or more objects",))
    if len(steps) > MAX_STEPS:
        return Unusable((f"{len(steps)} steps; at most {MAX_STEPS}",))
    return {"kind": "plan", "steps": [trimmed(step) for step in steps]}


def trimmed(step: dict[str, Any]) -> dict[str, Any]:
    """Drop fields that a grammar made the model fill with nothing; clean its words."""
    kept = {k: v for k, v in step.items() if v not in (None, "", [])}
    return {k: clean(v) if k in ("text", "question") and isinstance(v, str) else v
            for k, v in kept.items()}  # fmt: skip


def _words(kind: str, filled: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any] | Unusable:
    en, zh = filled.get("en") or filled.get("zh"), filled.get("zh") or filled.get("en")
    if not isinstance(en, str) or not isinstance(zh, str):
        return Unusable((f"{kind} needs the texts en and zh",))
    said = {"en": _short(en), "zh": _short(zh)}
    if not said["en"] or not said["zh"]:
        return Unusable((f"{kind} needs words in en and zh",))
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
    words = [short for each in options[:MAX_OPTIONS] if (short := _short(each))]
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


def _told(error: Any) -> str:
    """Say where pydantic found what; the value itself is not repeated."""
    return f"{'.'.join(clean(str(part))[:40] for part in error['loc'][:6])}: {error['msg'][:160]}"
