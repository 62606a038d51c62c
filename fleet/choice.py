"""Choose who goes: by what each can do, by its way and its load, and in turn. Pure."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from fleet.house import HouseRules
    from fleet.records import MissionRow

SEES = re.compile(
    r"\b(?:look|see|watch|find|check|search|inspect|photo|photograph|picture|camera|count)\b"
    r"|看|找|拍|照片|检查|查看|数一数",
    re.IGNORECASE,
)
"""A sentence with such a word needs eyes, where any robot has some."""
_PLAIN = re.compile(r"[^\[\]()<>{}|*+?$]+")
FAR = 1e6
"""Metres of a way that is not known: a robot that knows its own goes first."""
BARRED = 1e9
LOAD_M = 0.5
"""A robot for which one more order waits is as if so much further away."""


def place_names(card: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield each name of each place on a card, folded, with the place."""
    for place in card.get("places") or ():
        names = [str(place.get("id", "")).replace("_", " "), *(place.get("name") or {}).values()]
        for aliases in (place.get("aliases") or {}).values():
            names += aliases
        for name in names:
            if folded := str(name).casefold().strip():
                yield folded, place


def skill_names(card: Mapping[str, Any]) -> Iterator[str]:
    """Yield the words that call each of the owner's skills, where they are plain ones."""
    for skill in card.get("skills") or ():
        name = str(skill.get("name", "")).replace("_", " ")
        for words in (name, *(skill.get("en") or ()), *(skill.get("zh") or ())):
            if _PLAIN.fullmatch(str(words)) and len(folded := str(words).casefold().strip()) > 1:
                yield folded


def is_named(name: str, text: str) -> bool:
    """Return whether a sentence has a name in it, as a word where words have spaces."""
    if not name.isascii():
        return name in text
    return re.search(rf"(?<![a-z0-9]){re.escape(name)}(?![a-z0-9])", text) is not None


def steps_of(mission: MissionRow) -> list[dict[str, Any]]:
    """Return the steps of an order that was given as such, with those that they hold."""
    found: list[dict[str, Any]] = []
    left: list[Any] = list(json.loads(mission.body).get("steps") or ())
    while left:
        each = left.pop(0)
        if isinstance(each, dict):
            found += [each] if "kind" in each else []
            left += each.values()
        elif isinstance(each, list):
            left += each
    return found


@dataclass(slots=True)
class Abilities:
    """Know what each robot of a fleet can do, by its card, and which orders need it."""

    cards: Mapping[str, Mapping[str, Any]]
    _names: dict[str, frozenset[str]] = field(init=False)
    _known: tuple[str, ...] = field(init=False)
    _able: dict[str, frozenset[str]] = field(init=False, default_factory=dict)
    """Of each order that was judged: thousands may wait, and each is judged in every round."""

    def __post_init__(self) -> None:
        """Gather all names that any robot knows."""
        self._names = {
            robot: frozenset([*(name for name, _ in place_names(card)), *skill_names(card)])
            for robot, card in self.cards.items()
        }
        self._known = tuple(sorted(frozenset[str]().union(*self._names.values())))

    def able(self, mission: MissionRow, robots: Sequence[str]) -> list[str]:
        """Return those that know each place and skill of an order, its language, and have eyes.

        What no robot of the fleet has is left to the robot to tell.
        """
        if mission.id not in self._able:
            self._able[mission.id] = self._judge(mission)
        return [robot for robot in robots if robot in self._able[mission.id]]

    def forget_but(self, missions: Collection[str]) -> None:
        """Let go of orders that wait no more."""
        if len(self._able) > 2 * len(missions) + 100:
            self._able = {each: self._able[each] for each in missions if each in self._able}

    def _judge(self, mission: MissionRow) -> frozenset[str]:
        text, body = mission.text.casefold(), json.loads(mission.body)
        wanted = frozenset(name for name in self._known if is_named(name, text))
        language, steps = str(body.get("language")), steps_of(mission)
        needs_eyes = SEES.search(mission.text) is not None
        needs_eyes &= any(card.get("camera") for card in self.cards.values())

        def is_able(robot: str) -> bool:
            card = self.cards[robot]
            kinds, languages = card.get("steps"), card.get("languages")
            ids = {place.get("id") for place in card.get("places") or ()}
            return (
                wanted <= self._names[robot]
                and (not needs_eyes or bool(card.get("camera")))
                and (not languages or language in languages)
                and all(not kinds or step["kind"] in kinds for step in steps)
                and all(step.get("place") in {None, *ids} for step in steps)
            )

        return frozenset(robot for robot in self.cards if is_able(robot))

    def homes(
        self, mission: MissionRow, robots: Sequence[str], rules: HouseRules
    ) -> dict[str, list[str]]:
        """Return the homes that an order may mean, with their robots; one: nothing is to be asked.

        An order that names a place may mean each home that has one; the home's own name decides.
        """
        text = mission.text.casefold()
        placed = any(is_named(name, text) for card in self.cards.values()
                     for name, _ in place_names(card))  # fmt: skip
        placed |= any(step.get("place") for step in steps_of(mission))
        found: dict[tuple[str, str], list[str]] = {}
        for robot in robots if placed else ():
            found.setdefault(rules.home_of(self.cards[robot]), []).append(robot)
        said = {key: who for key, who in found.items() if is_named(key[1].casefold(), text)}
        found = said if len(said) == 1 else found
        names = [name for _, name in found]
        return {
            name if names.count(name) == 1 else f"{name} ({', '.join(who)})": who
            for (_, name), who in found.items()
        }


def assign(costs: Sequence[Sequence[float]]) -> list[tuple[int, int]]:
    """Return which order (row) goes to which robot (column) so that the sum is least."""
    if not costs or not costs[0]:
        return []
    if len(costs) == 1 or len(costs[0]) == 1:
        pairs = [min((cost, row, at) for row, line in enumerate(costs)
                     for at, cost in enumerate(line))[1:]]  # fmt: skip
    else:
        from scipy.optimize import linear_sum_assignment

        rows, columns = linear_sum_assignment(costs)
        pairs = [(int(row), int(at)) for row, at in zip(rows, columns, strict=True)]
    return [(row, at) for row, at in pairs if costs[row][at] < BARRED]
