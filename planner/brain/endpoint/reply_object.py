"""Find the one object, or the one list of steps, that a model's reply consists of. Pure.

Models wrap their JSON in code fences, in thoughts and in prose, and write it twice. Nothing is
mended here: what is cut off, holds NaN or a key twice is no JSON.
"""

from __future__ import annotations

import json
import re
from typing import Any

from planner.plan import EVERY_KIND

MAX_CHARACTERS = 64_000
"""Of what is no thought. A plan of 20 steps has under 16 000; the bound keeps reading quick."""
MAX_STARTS = 40
"""Braces at which an object is looked for."""

_TAG = re.compile(r"<(/?)(?:think|thinking|reasoning|thought)>", re.IGNORECASE)
_LIST = re.compile(r"\[\s*[\[{]")
_BROKEN = "the reply's JSON is cut off, too deep, malformed or repeats a key"
_MEANT = re.compile(r'\{\s*["{\[}]')  # "{name}" in prose is no object, '{"kind' is


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is no JSON number")


def _refuse_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object; refuse it where a key stands twice."""
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key stands twice in one object")
    return found


_DECODER = json.JSONDecoder(parse_constant=_no_constant, object_pairs_hook=_refuse_duplicates)


class NoObject(Exception):
    """There is no one object in the text; the message tells the model why."""


def one_object(text: str) -> dict[str, Any]:
    """Return the one object that a reply consists of; the same object twice counts as one.

    Raises:
        NoObject: there is none, or there are several.
    """
    spoken = without_thoughts(text)
    if len(spoken) > MAX_CHARACTERS:
        raise NoObject(f"the reply has {len(spoken)} characters; at most {MAX_CHARACTERS} are read")
    found = _objects(spoken)  # a fence says nothing: what is refused beside it counts as well
    distinct = [each for i, each in enumerate(found) if each not in found[:i]]
    if not distinct:
        raise NoObject(_why_none(text, spoken))
    if len(distinct) > 1:
        raise NoObject(f"the reply holds {len(distinct)} JSON objects; expected exactly one")
    return distinct[0]


def read_reply(text: str) -> dict[str, Any]:
    """Return the object that a reply is; steps without a plan around them are a plan.

    Raises:
        NoObject: it is neither one object nor one list of steps.
    """
    spoken = without_thoughts(text)
    begins = _LIST.search(spoken) if len(spoken) <= MAX_CHARACTERS else None
    if begins is not None and "{" not in spoken[: begins.start()]:
        return {"kind": "plan", "steps": _bare_list(spoken, begins.start())}
    reply = one_object(text)
    kind = reply.get("kind")
    if isinstance(kind, str) and kind in EVERY_KIND:
        return {"kind": "plan", "steps": [reply]}
    return {"kind": "plan", **reply} if kind is None and "steps" in reply else reply


def _bare_list(spoken: str, begins: int) -> list[dict[str, Any]]:
    """Return the list of steps that a reply consists of: of one that is cut off, no step counts."""
    try:
        value, end = _DECODER.raw_decode(spoken, begins)
    except (ValueError, RecursionError):
        raise NoObject(_BROKEN) from None
    if "{" in spoken[end:]:
        raise NoObject("the reply holds a list and more JSON; expected exactly one object")
    if not all(isinstance(each, dict) and "kind" in each for each in value):
        raise NoObject("the reply's list holds something that is no step")
    return list(value)


def without_thoughts(text: str) -> str:
    """Drop thoughts: closed ones, those that began before the reply, those that never end.

    One pass over the tags: a pattern for pairs takes quadratic time on tags that never close.
    """
    spoken: list[str] = []
    at, inside = 0, False
    for tag in _TAG.finditer(text):
        if tag[1]:
            if not inside:  # it began before the reply did
                spoken.clear()
            at, inside = tag.end(), False
        elif not inside:
            spoken.append(text[at : tag.start()])
            inside = True
    if not inside:
        spoken.append(text[at:])
    return "".join(spoken)


def _objects(text: str) -> list[dict[str, Any]]:
    """Return the outermost objects of a text, at most a handful; none where one is broken.

    What lies inside a broken object was never meant alone, so it is not looked at.
    """
    found: list[dict[str, Any]] = []
    at = text.find("{")
    for _ in range(MAX_STARTS):
        if at < 0:
            break
        try:
            value, end = _DECODER.raw_decode(text, at)
        except (ValueError, RecursionError):
            if _MEANT.match(text, at):
                return []
            end = at + 1
        else:
            found.append(value)
        at = text.find("{", end)
    return found


def _why_none(text: str, spoken: str) -> str:
    if not text.strip():
        return "the reply is empty"
    if not spoken.strip():
        return "the reply holds thoughts alone and no JSON object"
    if "{" not in spoken:
        return "the reply holds no JSON object"
    return _BROKEN
