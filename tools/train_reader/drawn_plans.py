"""Draw plans of the closed grammar, weighted towards what is read worst: several steps, conditions,
denials, corrections, choices, who acts, standing orders, talk that names places.

Each draw is a label in the notation with a hint: what the sentence does that the label can't say.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

WORDS = Path(__file__).parent / "words"
_HOME_NAMES = (5, 8)


@cache
def words_of(language: str) -> dict[str, tuple[str, ...]]:
    """Return the sections of a language's words by name."""
    found: dict[str, tuple[str, ...]] = {}
    name = ""
    for line in (WORDS / f"{language}.txt").read_text("utf-8").splitlines():
        if line.startswith("["):
            name = line.strip("[]")
        elif line and not line.startswith("#"):
            found[name] = tuple(line.split(" | "))
    return found


@dataclass
class PlanDraw:
    """Draw the parts of one plan: of one home, no place or thing twice."""

    random: Random
    language: str
    hint: str = ""
    _homes: tuple[str, ...] = field(init=False)
    _used: set[str] = field(default_factory=set, init=False)
    home: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        words = words_of(self.language)
        homes = [name for name in words if name.startswith("home ")]
        places = words[self.random.choice(homes)]
        count = min(self.random.randint(*_HOME_NAMES), len(places))
        self.home = tuple(self.random.sample(places, count))

    def one(self, section: str) -> str:
        """Return a text of a section that this plan doesn't hold yet."""
        left = [text for text in words_of(self.language)[section] if text not in self._used]
        text = self.random.choice(left)
        self._used.add(text)
        return text

    def place(self) -> str:
        """Return a place of the home that this plan doesn't hold yet."""
        left = [place for place in self.home if place not in self._used]
        place = self.random.choice(left or self.home)
        self._used.add(place)
        return place

    def thing(self) -> str:
        """Return a thing in quotes."""
        return f'"{self.one("things")}"'

    def somebody(self) -> str:
        """Return a person, or anyone, in quotes."""
        return f'"{self.one("people" if self.random.random() < 0.7 else "anyone")}"'

    def sight(self) -> str:
        """Return what a look may ask for, in quotes."""
        chance = self.random.random()
        if chance < 0.3:
            return self.thing()
        return self.somebody() if chance < 0.6 else f'"{self.one("states")}"'

    def often(self, share: float) -> bool:
        """Return true in this share of draws."""
        return self.random.random() < share

    def pick(self, *texts: str) -> str:
        """Return one of these."""
        return self.random.choice(texts)

    def in_place(self, share: float) -> str:
        """Return ``, in kitchen`` in this share of draws."""
        return f", in {self.place()}" if self.often(share) else ""

    def fill(self, section: str) -> str:
        """Return a hint with places, things and people filled in."""
        text = self.one(section)
        for mark, word in (("{p}", self.place()), ("{q}", self.place())):
            text = text.replace(mark, word)
        return text.replace("{t}", self.one("things")).replace("{who}", self.one("people"))


def _duration(draw: PlanDraw) -> str:
    return draw.pick("30 s", "1 min", "2 min", "5 min", "10 min", "0.5 h", "20 s", "3 min", "a bit")


def _length(draw: PlanDraw) -> str:
    return draw.pick("1 m", "2 m", "0.5 m", "30 cm", "1.5 m", "20 cm", "3 ft", "a bit", "a bit")


def _turn(draw: PlanDraw) -> str:
    turn = draw.pick("left", "right", "around", "full")
    if turn in ("left", "right") and draw.often(0.6):
        return f"turn({turn}, {draw.pick('90 deg', '45 deg', '30 deg', '180 deg', 'a bit')})"
    return f"turn({turn})"


def _move(draw: PlanDraw) -> str:
    return f"move({draw.pick('forward', 'backward')}, {_length(draw)})"


def _say(draw: PlanDraw) -> str:
    to = f', to "{draw.one("people")}"' if draw.often(0.6) else ""
    return f'say("{draw.one("sayings")}"{to})'


def _ask(draw: PlanDraw) -> str:
    to = f', to "{draw.one("people")}"' if draw.often(0.6) else ""
    return f'ask("{draw.one("questions")}"{to})'


def _round(draw: PlanDraw) -> str:
    kind = draw.pick("patrol", "inspect", "inspect")
    if draw.often(0.45):
        return f"{kind}(all, except {draw.place()})" if draw.often(0.4) else f"{kind}(all)"
    return f"{kind}({' + '.join(draw.place() for _ in range(draw.random.randint(2, 3)))})"


def _stand(draw: PlanDraw) -> str:
    target = f"at {draw.place()}" if draw.often(0.6) else f"by {draw.thing()}"
    return f"stand({draw.pick('before', 'beside', 'behind', 'facing')}, {target})"


def _follow(draw: PlanDraw) -> str:
    inside = [draw.somebody()] if draw.often(0.4) else []
    inside += [f"for {draw.pick('1 min', '2 min', '5 min')}"] if draw.often(0.2) else []
    return f"follow({', '.join(inside)})" if inside else "follow"


def _wait(draw: PlanDraw) -> str:
    chance = draw.random.random()
    if chance < 0.45:
        return f"wait({_duration(draw)})"
    if chance < 0.75:
        return f"wait_for({draw.somebody()})"
    if chance < 0.87:
        return f'wait_word("{draw.one("wake words")}")'
    return f'wait_until("{draw.one("clock")}")'


def _look(draw: PlanDraw) -> str:
    return f"look(in {draw.place()})" if draw.often(0.75) else "look"


def _find(draw: PlanDraw) -> str:
    what = draw.thing() if draw.often(0.75) else draw.somebody()
    return f"find({what}{draw.in_place(0.6)})"


def _check(draw: PlanDraw) -> str:
    return f"check({draw.sight()}{draw.in_place(0.85)})"


def _count(draw: PlanDraw) -> str:
    return f'count("{draw.one("countables")}"{draw.in_place(0.75)})'


SIMPLE: tuple[tuple[float, Callable[[PlanDraw], str]], ...] = (
    (14, lambda draw: f"go({draw.place()})"),
    (12, _check),
    (9, _look),
    (10, _find),
    (6, _count),
    (4, lambda draw: "home"),
    (5, lambda draw: "back"),
    (5, _turn),
    (5, _move),
    (5, _follow),
    (4, _round),
    (4, _stand),
    (4, lambda draw: f"approach({draw.thing()}{draw.in_place(0.3)})"),
    (3, _say),
    (2, _ask),
    (3, _wait),
    (1, lambda draw: "explore"),
)
ACTS: tuple[tuple[float, Callable[[PlanDraw], str]], ...] = (
    (8, lambda draw: "back"),
    (4, lambda draw: "home"),
    (8, _say),
    (5, _ask),
    (6, lambda draw: f"go({draw.place()})"),
    (5, _check),
    (5, _find),
    (4, _wait),
    (3, _look),
    (2, _turn),
    (1, _follow),
    (2, _round),
)


ROUNDS: tuple[tuple[float, Callable[[PlanDraw], str]], ...] = (
    (3, lambda draw: f"wait({_duration(draw)})"),
    (3, _round),
    (2, lambda draw: f"turn({draw.pick('left', 'right')}, a bit)"),
    (2, lambda draw: f"move({draw.pick('forward', 'backward')}, a bit)"),
    (1, lambda draw: f"follow({draw.somebody()})"),
    (1, _say),
    (1, lambda draw: "explore"),
)
"""What may be done again until something is so."""


def draw_from(draw: PlanDraw, table: tuple[tuple[float, Callable[[PlanDraw], str]], ...]) -> str:
    """Return one of a weighted table."""
    weights = [weight for weight, _ in table]
    return draw.random.choices([made for _, made in table], weights)[0](draw)


def draw_simple(draw: PlanDraw) -> str:
    """Return one step."""
    return draw_from(draw, SIMPLE)


def draw_several(draw: PlanDraw) -> str:
    """Return two to four steps that people would string together."""
    chance = draw.random.random()
    if chance < 0.3:
        makers = (_say, _ask, _wait, _turn)
        steps = [f"go({draw.place()})", draw.random.choice(makers)(draw)]
    elif chance < 0.5:
        steps = [draw.random.choice((_find, _check, _look, _count))(draw) for _ in range(2)]
    else:
        steps = [draw_simple(draw), draw_from(draw, ACTS)]
    if draw.often(0.4):
        steps.append(draw_from(draw, ACTS))
    if draw.often(0.35):
        steps.append(draw.pick("back", "home"))
    return "; ".join(step for number, step in enumerate(steps) if step not in steps[:number])


def _row(draw: PlanDraw, most: int = 2) -> str:
    steps = [draw_from(draw, ACTS) for _ in range(draw.random.randint(1, most))]
    return "; ".join(step for number, step in enumerate(steps) if step not in steps[:number])


def _condition(draw: PlanDraw) -> str:
    chance = draw.random.random()
    if chance < 0.62:
        return _check(draw)
    if chance < 0.74:
        return _find(draw)
    if chance < 0.84:
        return _ask(draw)
    if chance < 0.9:
        return f"recall({draw.somebody()}{draw.in_place(0.5)})"
    return f'{draw.pick("later", "earlier")}("{draw.one("clock")}")'


def draw_condition(draw: PlanDraw) -> str:
    """Return a plan with a branch, a loop or an attempt in it."""
    chance = draw.random.random()
    before = f"{draw_simple(draw)}; " if draw.often(0.2) else ""
    if chance < 0.62:
        denied = "not " if draw.often(0.3) else ""
        branch = f"if {denied}{_condition(draw)} {{ {_row(draw)} }}"
        return before + branch + (f" else {{ {_row(draw)} }}" if draw.often(0.55) else "")
    if chance < 0.76:
        denied = "not " if draw.often(0.2) else ""
        return f"{before}until {denied}{_check(draw)} {{ {draw_from(draw, ROUNDS)} }}"
    if chance < 0.9:
        often = draw.pick("2 times", "3 times", "4 times", "for 5 min", "for 10 min", "5 times")
        return f"repeat({often}) {{ {_row(draw)} }}"
    tried = draw.pick(f"go({draw.place()})", _find(draw))
    return f"try {{ {tried} }} else {{ {_row(draw, 1)} }}"
