"""Name the directions that a look has gazed in, from how the robot stood when it began. Pure."""

from __future__ import annotations

from math import pi

from planner.language.catalogue import list_names, say
from planner.plan import Bilingual
from wire import wrap

AHEAD = say("direction.ahead")
_NAMES = (
    AHEAD,
    say("direction.ahead_on_left"),
    say("direction.left"),
    say("direction.behind_on_left"),
    say("direction.behind"),
    say("direction.behind_on_right"),
    say("direction.right"),
    say("direction.ahead_on_right"),
)
"""Counter-clockwise, an eighth of a turn each."""
SLACK_RAD = 0.3
"""Two neighbours may be so much farther apart: the bridge reaches a heading within 0.1."""


def direction(left_rad: float) -> Bilingual:
    """Name a direction by its angle to the left of ahead."""
    return _NAMES[round(wrap(left_rad) * len(_NAMES) / (2.0 * pi)) % len(_NAMES)]


def goes_round(faced: tuple[float, ...], views: int) -> bool:
    """Tell whether these directions leave no gap in a whole turn of so many views."""
    if not faced:
        return False
    at = sorted(angle % (2.0 * pi) for angle in faced)
    gaps = [after - before for before, after in zip(at, (*at[1:], at[0] + 2.0 * pi), strict=True)]
    return max(gaps) <= 2.0 * pi / views + SLACK_RAD


def list_directions(names: tuple[Bilingual, ...]) -> Bilingual:
    """Return names as a list, each once: ``ahead, left and behind``."""
    once = tuple(dict.fromkeys(names))
    return list_names(once, "joint.and")
