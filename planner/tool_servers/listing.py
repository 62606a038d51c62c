"""Judge what a server says of its tools, and keep what the owner lets be asked. Pure.

Law: a server's own word that a tool only reads counts where the owner named none of its tools, and
its word that a tool writes counts always. What is neither listed nor marked is not offered. What a
tool says of itself is data: one line, cut, without marks that hide or turn text.
"""

from __future__ import annotations

import json
import unicodedata
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

from pydantic import ValidationError

from planner.plan import Tool, ToolParameter
from planner.plan.tool import MOST_ARGUMENTS, ArgumentKind

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from planner.settings import ToolServerSettings

MOST_ABOUT = 100
_KINDS: tuple[ArgumentKind, ...] = get_args(ArgumentKind)
_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn"})


@dataclass(frozen=True, slots=True)
class ToolListing:
    """Hold the tools of one server that may be asked, and why the others may not."""

    tools: tuple[Tool, ...] = ()
    left_out: tuple[tuple[str, str], ...] = ()
    """The name of each other tool, and a stable code."""


def judge_listing(
    server: str, settings: ToolServerSettings, listed: Sequence[Mapping[str, Any]]
) -> ToolListing:
    """Return what of a server's list is offered; a name that stands twice is its first."""
    tools: dict[str, Tool] = {}
    left_out: dict[str, str] = {}
    for each in listed:
        name = str(each.get("name"))
        if name in tools or name in left_out:
            continue
        tool = _judge(server, settings, each)
        if isinstance(tool, Tool):
            tools[name] = tool
        else:
            left_out[clean(name, 64)] = tool
    named = (*(settings.allow or ()), *settings.may_write)
    left_out |= {name: "tool_not_there" for name in named if name not in {*tools, *left_out}}
    order = {name: at for at, name in enumerate(named)}
    kept = sorted(tools.items(), key=lambda item: order.get(item[0], len(order)))
    return ToolListing(tuple(tool for _, tool in kept), tuple(left_out.items()))


def _judge(server: str, settings: ToolServerSettings, listed: Mapping[str, Any]) -> Tool | str:
    """Return a tool, or the code of why it is not offered."""
    name = str(listed.get("name"))
    hints = listed.get("annotations")
    reads = hints.get("readOnlyHint") if isinstance(hints, dict) else None
    writes = name in settings.may_write
    is_listed = writes or name in (settings.allow or ())
    if not is_listed and settings.allow is not None:
        return "tool_not_listed"
    if not is_listed and reads is not True:
        return "tool_unmarked"
    if not writes and reads is False:
        return "tool_writes"
    parameters = _parameters(listed.get("inputSchema"))
    if parameters is None:
        return "tool_unusable"
    about = clean(listed.get("description"), MOST_ABOUT)
    try:
        return Tool(name=f"{server}.{name}", about=about, parameters=parameters, writes=writes)
    except ValidationError:
        return "tool_unusable"


def _parameters(schema: object) -> tuple[ToolParameter, ...] | None:
    """Return a tool's parameters, the required ones first; None: it can't be called from a plan."""
    shapes = schema.get("properties", {}) if isinstance(schema, dict) else None
    wanted = schema.get("required", []) if isinstance(schema, dict) else None
    if not isinstance(shapes, dict) or not isinstance(wanted, list):
        return None
    needed = [name for name in shapes if name in wanted]
    if len(needed) > MOST_ARGUMENTS or len(needed) != len(wanted):
        return None
    rest = [name for name in shapes if name not in needed]
    if any("x-mcp-header" in shapes[n] for n in shapes if isinstance(shapes[n], dict)):
        return None  # it would have to be sent in a header of its own as well
    try:
        return tuple(
            ToolParameter(name=name, kind=_kind(shapes[name]), required=name in needed)
            for name in [*needed, *rest][:MOST_ARGUMENTS]
        )
    except ValidationError:
        return None


def _kind(shape: object) -> ArgumentKind:
    """Return the JSON type of a parameter: of several, the first that is not null."""
    return next((kind for each in _shapes(shape) for kind in _KINDS if each == kind), "string")


def _shapes(shape: object) -> Iterable[Any]:
    if not isinstance(shape, dict):
        return
    kind = shape.get("type")
    yield from kind if isinstance(kind, list) else (kind,)
    for name in ("anyOf", "oneOf"):
        for inner in shape.get(name, ()) if isinstance(shape.get(name), list) else ():
            yield inner.get("type") if isinstance(inner, dict) else None


def clean(text: object, most: int) -> str:
    """Return a stranger's text in one line without hidden marks, cut to so many characters."""
    plain = " ".join(text[: 8 * most].split()) if isinstance(text, str) else ""
    seen = "".join(char for char in plain if unicodedata.category(char) not in _HIDDEN)
    return seen if len(seen) <= most else f"{seen[: most - 1]}…"


def arguments_of(tool: Tool, given: Sequence[str]) -> dict[str, Any]:
    """Return a call's arguments by name and in their JSON types.

    Raises:
        ValueError: the name of the parameter whose words are none of its type, or that is missing.
    """
    found: dict[str, Any] = {}
    if len(given) > len(tool.parameters):
        raise ValueError(f"{len(given)} arguments; at most {len(tool.parameters)}")
    if missing := tool.find_missing(tuple(given)):
        raise ValueError(", ".join(missing))
    for parameter, words in zip(tool.parameters, given, strict=False):
        if not words.strip():
            continue
        try:
            found[parameter.name] = _value(parameter.kind, words.strip())
        except (ValueError, RecursionError):
            raise ValueError(parameter.name) from None
    return found


def _value(kind: ArgumentKind, words: str) -> Any:
    if kind == "string":
        return words
    if kind == "integer":
        return int(words)
    if kind == "array" and not words.startswith("["):
        return [each.strip() for each in words.split(",")]
    value = json.loads(words, parse_constant=float_refused)
    expected = {"number": int | float, "boolean": bool, "array": list, "object": dict}[kind]
    if not isinstance(value, expected) or (kind == "number" and isinstance(value, bool)):
        raise ValueError(words)
    return value


def float_refused(name: str) -> float:
    """Refuse NaN and infinity, which JSON does not have."""
    raise ValueError(name)
