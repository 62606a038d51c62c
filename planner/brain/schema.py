"""Own the shape in which a model replies: one flat object, and its plain JSON schema per request.

Flat but for the steps that others hold, which stand one deep: servers turn a schema into a grammar,
and few of them know `$ref`, `oneOf`, `const` or patterns. Steps and their fields come from the
plan's own models, so that a step which becomes runnable is offered at once. What the schema can't
say is judged by `endpoint.judge`.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Literal, get_args

from planner.plan import (
    CONDITIONS,
    CONTROL,
    GIVEN,
    RUNNABLE,
    ClockTime,
    Code,
    Frozen,
    PlanRole,
    Step,
    Vocabulary,
)
from planner.plan.order_steps import ORDER_STEPS

NAME = "plan"
"""The schema's name, and the forced tool's."""
KINDS = ("plan", "answer", "clarify", "refuse")
CLARIFY_CODES = (
    Code.AMBIGUOUS,
    Code.UNKNOWN_PLACE,
    Code.NOT_UNDERSTOOD,
    Code.CONDITIONAL,
    Code.NO_CAPABILITY,
    Code.NO_CAMERA,
    Code.NO_DETECTOR,
)
REFUSE_CODES = (
    Code.NO_CAPABILITY,
    Code.NO_CAMERA,
    Code.NO_DETECTOR,
    Code.UNSAFE,
    Code.NEGATED,
    Code.CONDITIONAL,
    Code.OUT_OF_SCOPE,
    Code.NOT_UNDERSTOOD,
)
EVIDENCE = "because"
"""Under this name a model quotes the words of the person that ask for a step."""
Message = dict[Literal["role", "content"], str]
_PLACES = frozenset({"place", "places"})
_HOLDS_STEPS = frozenset({"then", "otherwise", "steps", "on_failure"})
_HOLDS_CONDITION = frozenset({"when", "until"})
_CLOCK = frozenset({"time", "after", "before"})
_TOLD_AS = {"angle_rad": "angle_deg"}
"""People say degrees and models write them; the plan keeps radians (``endpoint.plan_reply``)."""
MOST_DEG = 720
_PLAIN = CONTROL - {"try"}
"""Steps whose fields say what they do."""
_UNTOLD = {"repeat": ("seconds",), "wait_for": ("seconds",)}
"""Fields whose bound is said nowhere: a model may leave them to it."""


def step_models(runnable: frozenset[str] = RUNNABLE) -> dict[str, type[Frozen]]:
    """Return the models of the steps that may be offered, by their kind, in the plan's order."""
    union, *_ = get_args(Step)
    models = {_kind(model): model for model in get_args(union)}
    return {kind: model for kind, model in models.items() if kind in runnable - GIVEN}


def step_line(model: type[Frozen]) -> str:
    """Describe one step to a model: its kind, its other fields and its effect."""
    kind = _kind(model)
    shapes = {n: shape for n, shape in _fields(model).items() if n not in _UNTOLD.get(kind, ())}
    fields = [
        f'"{_name_for_model(name)}"{_optional(model, name)}:{_describe_field(name, shape)}'
        for name, shape in shapes.items()
    ]
    shown = f"{kind} {{{','.join(fields)}}}"
    return shown if kind in _PLAIN else f"{shown} {(model.__doc__ or '').splitlines()[0]}"


@lru_cache(maxsize=16)
def schema_of(vocabulary: Vocabulary, runnable: frozenset[str] = RUNNABLE) -> dict[str, Any]:
    """Return the schema of a reply in one closed world. Shared: never change it."""
    ids = [entry.id for entry in vocabulary.entries]
    models = step_models(runnable)
    if not ids:  # an empty enum is no schema
        models = {k: m for k, m in models.items() if not _PLACES & _fields(m).keys()}
    named = [tool.name for tool in vocabulary.tools]
    tools = {"tool": {"type": "string", "enum": named}} if named else {}
    held = _step_object({k: m for k, m in models.items() if k not in CONTROL}, ids, tools)
    asked = {k: m for k, m in models.items() if k in CONDITIONS} | {"clock": ClockTime}
    condition = _step_object(asked, ids, {})
    parts: dict[str, Any] = {name: {"type": "array", "items": held} for name in _HOLDS_STEPS}
    parts |= tools
    parts |= dict.fromkeys(_HOLDS_CONDITION, condition)
    step = _step_object(models | ORDER_STEPS, ids, parts)
    codes = dict.fromkeys(code.value for code in (*CLARIFY_CODES, *REFUSE_CODES))
    return _object(
        {
            "kind": {"type": "string", "enum": list(KINDS)},
            "does": {"type": "string", "enum": [role.value for role in PlanRole]},
            "pace": {"type": "string", "enum": ["slow"]},
            "steps": {"type": "array", "items": step},
            "code": {"type": "string", "enum": list(codes)},
            "text": {"type": "string"},
            "options": {"type": "array", "items": {"type": "string"}},
        }
    )


def _step_object(
    models: dict[str, type[Frozen]], ids: list[str], parts: dict[str, Any]
) -> dict[str, Any]:
    """Return the schema of any of these steps; ``parts``: of the fields that hold steps."""
    step: dict[str, Any] = {"kind": {"type": "string", "enum": list(models)}}
    for model in models.values():
        for name, shape in _fields(model).items():
            one = parts[name] if name in parts else _plain(name, shape, ids)
            step.setdefault(_name_for_model(name), one)
    return _object(step | {EVIDENCE: {"type": "string"}})


def _object(properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": ["kind"],
        "additionalProperties": False,
    }


def _optional(model: type[Frozen], name: str) -> str:
    """Mark a field that may be left out: filled in anyway, it drives where nobody said."""
    return "" if model.model_fields[name].is_required() else "?"


def _name_for_model(name: str) -> str:
    """Return a field's name as a model is told it."""
    return _TOLD_AS.get(name, name)


def _kind(model: type[Frozen]) -> str:
    (kind,) = get_args(model.model_fields["kind"].annotation)
    return str(kind)


@lru_cache(maxsize=64)
def _fields(model: type[Frozen]) -> dict[str, dict[str, Any]]:
    """Return the JSON schemas of a step's own fields; what holds steps is told by its name."""
    schema = model.model_json_schema()
    name = schema.get("$ref", "").rpartition("/")[2]
    properties: dict[str, dict[str, Any]] = (schema["$defs"][name] if name else schema)[
        "properties"
    ]
    return {name: shape for name, shape in properties.items() if name != "kind"}


def _type(shape: dict[str, Any]) -> str:
    """Return the JSON type of a field; of an optional one, the type where it is there."""
    return str(shape.get("type") or shape["anyOf"][0]["type"])


def _choices(shape: dict[str, Any]) -> list[str]:
    """Return the words that a field may hold, where it is no free text."""
    words: list[str] = (shape if "enum" in shape else shape.get("anyOf", [{}])[0]).get("enum", [])
    return words


def _plain(name: str, shape: dict[str, Any], ids: list[str]) -> dict[str, Any]:
    kind, choices = _type(shape), _choices(shape)
    if choices:
        return {"type": kind, "enum": choices}
    plain = "string" if kind == "array" else kind
    one = {"type": "string", "enum": ids} if name in _PLACES else {"type": plain}
    return {"type": "array", "items": one} if kind == "array" else one


def _describe_field(name: str, shape: dict[str, Any]) -> str:
    """Name a field's content in a word."""
    if name in _HOLDS_STEPS:
        return "[…]"
    if name in _TOLD_AS:
        return f"-{MOST_DEG} to {MOST_DEG}"
    if name in _HOLDS_CONDITION:
        return "condition"
    if name in _CLOCK:
        return '"HH:MM"'
    if name in _PLACES:
        return "[id,…]" if _type(shape) == "array" else "id"
    if _type(shape) == "boolean":
        return "true"
    if _type(shape) == "string":
        return f'"{"|".join(_choices(shape))}"' if name == "side" else '"…"'
    shape = shape if "type" in shape else shape["anyOf"][0]
    low = shape.get("minimum", shape.get("exclusiveMinimum"))
    told = [f"{int(100.0 * float(bound)) / 100.0:g}" for bound in (low or 0.0, shape["maximum"])]
    return " to ".join(told)  # cut towards zero: within the bounds
