"""Read the order and the closed world out of a chat request. Any client's; nothing is required."""

from __future__ import annotations

import json
import re
from typing import Any

from pydantic import ValidationError

from planner.brain import ThinkRequest
from planner.language.folding import has_chinese
from planner.plan import EVERY_KIND, RUNNABLE, Bilingual, Entry, Language, Vocabulary

MAX_DEPTH = 12
MAX_PLACES = 2000
_LINE = re.compile(r"^(?:- )?([a-z0-9][a-z0-9_]{0,63})(?: home)?: (\[.*\])$", re.MULTILINE)
_STEP = re.compile(r"^([a-z_]+) \{", re.MULTILINE)


def request_of(body: dict[str, Any]) -> ThinkRequest:
    """Return the offline brain's request."""
    texts = [(m.get("role"), _words(m.get("content"))) for m in _dicts(body.get("messages"))]
    page = "\n".join(text for _, text in texts)
    vocabulary = _vocabulary(page, body)
    offered = EVERY_KIND & set(_STEP.findall(page) or _allowed_words(body, "kind", 0))
    for role, text in texts:  # our prompt's message; a repair turn comes after it
        order = _order(text) if role == "user" else None
        if order is not None:
            return _think_request(order, vocabulary, offered or RUNNABLE)
    said = [text for role, text in texts if role == "user"]
    text = said[-1] if said else ""
    return ThinkRequest(text=text, vocabulary=vocabulary, runnable=offered or RUNNABLE)


def _think_request(
    order: dict[str, Any], vocabulary: Vocabulary, runnable: frozenset[str]
) -> ThinkRequest:
    room, language = order.get("robot_is_in"), order.get("language")
    answer = order.get("answer")  # to a question of ours about the order
    return ThinkRequest(
        text=answer if isinstance(answer, str) else str(order["order"]),
        vocabulary=vocabulary,
        runnable=runnable,
        room=room if isinstance(room, str) else None,
        language=Language(language) if language in set(Language) else None,
    )


def _order(text: str) -> dict[str, Any] | None:
    """Return the object with the order, also where the system's words stand before it."""
    try:
        found = json.loads(text[text.rfind("\n{") + 1 :])
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) and isinstance(found.get("order"), str) else None


def _vocabulary(text: str, body: dict[str, Any]) -> Vocabulary:
    """Return the places: the prompt's lines, then what the schema lists beyond them."""
    named = {found[1]: _entry(found[1], found[2]) for found in _LINE.finditer(text)}
    entries = {id_: entry for id_, entry in named.items() if entry is not None}
    for id_ in _allowed_words(body, "place", 0):
        words = id_.replace("_", " ")
        try:
            entries.setdefault(id_, Entry(id=id_, kind="place", name=Bilingual(en=words, zh=words)))
        except ValidationError:
            continue  # an enum of other things
    return Vocabulary(entries=tuple(entries.values())[:MAX_PLACES])


def _entry(id_: str, listed: str) -> Entry | None:
    try:
        names = [name for name in json.loads(listed) if isinstance(name, str) and name.strip()]
        first = names[0] if names else id_.replace("_", " ")  # an id may be a mere code
        name = Bilingual(
            en=next((n for n in names if not has_chinese(n)), first),
            zh=next((n for n in names if has_chinese(n)), first),
        )
        return Entry(id=id_, kind="place", name=name, aliases=tuple(names))
    except (ValueError, RecursionError, ValidationError):
        return None


def _allowed_words(node: object, field: str, depth: int) -> list[str]:
    """Return the words that a schema somewhere in the request allows for a field."""
    if depth > MAX_DEPTH:
        return []
    if isinstance(node, list):
        return [word for each in node for word in _allowed_words(each, field, depth + 1)]
    if not isinstance(node, dict):
        return []
    shape = node.get(field)
    words = shape.get("enum") if isinstance(shape, dict) else None
    here = [word for word in words if isinstance(word, str)] if isinstance(words, list) else []
    deeper = (_allowed_words(each, field, depth + 1) for each in node.values())
    return [*here, *(word for words in deeper for word in words)]


def _words(content: object) -> str:
    """Return a message's text, whether it is one or a list of parts."""
    if isinstance(content, str):
        return content
    return "\n".join(str(part.get("text", "")) for part in _dicts(content))


def _dicts(value: object) -> list[dict[str, Any]]:
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []
