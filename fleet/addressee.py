"""Read to whom a sentence is said: one, several, each, all but some, anyone, or the nearest. Pure.

The order itself is not read here: what is left of the sentence goes to the robot as it was said.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from fleet.errors import FleetError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

Way = Literal["any", "nearest", "named", "each"]
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,31}")

_END = r"(?:\s*[,，:：;；、]\s*|\s+|$)"
_GLUE = r"(?:\s*[,，:：;；、]\s*|\s*)"
_LISTED = r"(?:\s*(?:,|，|、|and|&|和|跟|与|or|或)\s*)"
_TABLE: tuple[tuple[Way, str], ...] = (
    ("each", rf"(?:everybody|everyone|all\s+of\s+you|all\s+(?:the\s+)?robots|every\s+robot|each\s+of\s+you){_END}"),
    ("each", rf"(?:大家|所有的?机器人|每[个台]机器人|全体|各位|你们){_GLUE}(?:都|全|全部)?"),
    ("nearest", rf"(?:the\s+)?(?:nearest|closest)(?:\s+(?:robot|one|of\s+you))?{_END}"),
    ("nearest", rf"(?:离.{{0,12}}?)?最近的(?:机器人|那[个台])?{_GLUE}"),
    ("any", rf"(?:(?:can|could|will|would)\s+)?(?:somebody|someone|anybody|anyone|any\s+robot|one\s+of\s+you|some\s+robot){_END}(?:please\s+)?"),
    ("any", rf"(?:请)?(?:随便)?(?:谁|哪[个台](?:机器人)?|有没有人)(?:能|可以|愿意)?(?=去|来|帮|把|看|送|到|回){_GLUE}"),
    ("any", rf"(?:来|找|派)(?:个人|一[个台](?:机器人)?|[个台]机器人){_GLUE}"),
)  # fmt: skip
"""What begins a sentence to more than one; the first row that fits. A question ("谁在厨房") is none."""
_BUT_EN = r"(?:everybody|everyone|all(?:\s+of\s+you|\s+(?:the\s+)?robots)?)\s+(?:but|except(?:\s+for)?)\s+"
_BUT_ZH = r"(?:除了?)\s*"
_BUT_ZH_END = rf"(?:以外|之外|外)?{_GLUE}(?:大家|其他人|其他的?机器人|其余的?|所有的?机器人)?{_GLUE}(?:都|全)?"
_ASK = r"(?:(?:tell|ask|send|let)\s+|让|叫|请|派)"
STOPS = re.compile(r"\b(?:stop|halt|freeze|whoa)\b|停|别动|不要动", re.IGNORECASE)
"""A sentence with such a word may mean a stop, so that it waits for no robot to be free."""
_BARE_STOP = re.compile(
    r"(?:please\s+)?(?:stop|halt|freeze)(?:\s+(?:now|at\s+once|immediately))?|(?:请|马上|立刻|都)*(?:停|停下|停止|停下来|别动|不要动)",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class Addressee:
    """Say who may go. ``named`` and ``each`` hold the names of all that shall."""

    way: Way
    names: tuple[str, ...] = ()


def read_addressee(text: str, known: Collection[str]) -> tuple[Addressee | None, str]:
    """Return to whom a sentence is said and what is left of it; None: it names nobody.

    Raises:
        FleetError: ``unknown_robot`` of a name with a colon behind it that no robot has.
    """
    said = text.strip()
    names = {name.casefold(): name for name in known}
    listed = "|".join(sorted(map(re.escape, names), key=len, reverse=True)) or r"(?!)"
    one = rf"(?<![A-Za-z0-9_-])(?:{listed})(?![A-Za-z0-9_-])"
    several = rf"({one}(?:{_LISTED}{one})*)"
    for pattern in (rf"{_BUT_EN}{several}{_END}", rf"{_BUT_ZH}{several}\s*{_BUT_ZH_END}"):
        if found := re.match(pattern, said, re.IGNORECASE):
            left_out = _names_in(found[1], one, names)
            rest = tuple(name for name in sorted(known) if name not in left_out)
            return Addressee("each", rest), _order(said, found.end())
    for way, pattern in _TABLE:
        if found := re.match(pattern, said, re.IGNORECASE):
            all_of = tuple(sorted(known)) if way == "each" else ()
            return Addressee(way, all_of), _order(said, found.end())
    named = rf"{_ASK}{several}(?:\s+to\s+|{_GLUE})|{several}(?:\s*[,，:：;；、]\s*|\s+|(?=[^\x00-\x7f])|$)"
    if found := re.match(named, said, re.IGNORECASE):
        asked = _names_in(found[1] or found[2], one, names)
        return Addressee("named" if len(asked) == 1 else "each", asked), _order(said, found.end())
    if found := re.match(rf"({NAME.pattern})\s*[:：]", said):
        raise unknown_robot(found[1], known)
    return None, said


def to_names(given: Iterable[str], known: Collection[str]) -> tuple[str, ...]:
    """Return robots by their names as they are written here, each once.

    Raises:
        FleetError: ``unknown_robot``.
    """
    names = {name.casefold(): name for name in known}
    missing = [name for name in given if name.casefold() not in names]
    if missing:
        raise unknown_robot(missing[0], known)
    return tuple(dict.fromkeys(names[name.casefold()] for name in given))


def unknown_robot(name: str, known: Collection[str]) -> FleetError:
    """Return the refusal of a name, with those that there are."""
    return FleetError("unknown_robot", name=name[:32], known=", ".join(sorted(known)[:30]) or "-")


def is_free_name(name: str) -> bool:
    """Return whether a robot may be called so: a plain name that addresses nobody else."""
    if NAME.fullmatch(name) is None or STOPS.search(name):
        return False
    return read_addressee(f"{name} go home", ())[0] is None


def is_stop(order: str) -> bool:
    """Return whether an order is a bare stop."""
    return _BARE_STOP.fullmatch(order.strip(" \t.!。！,，")) is not None


def _names_in(text: str, one: str, names: dict[str, str]) -> tuple[str, ...]:
    found = re.findall(one, text, re.IGNORECASE)
    return tuple(dict.fromkeys(names[name.casefold()] for name in found))


def _order(said: str, end: int) -> str:
    return said[end:].strip(" \t,，:：;；、")
