"""Name the directions that a look has gazed in, from how the robot stood when it began. Pure."""

from __future__ import annotations

from math import pi

from planner.plan import Bilingual
from wire import wrap

AHEAD = Bilingual(en="ahead", zh="前方")
_NAMES = (
    AHEAD,
    Bilingual(en="ahead on the left", zh="左前方"),
    Bilingual(en="left", zh="左侧"),
    Bilingual(en="behind on the left", zh="左后方"),
    Bilingual(en="behind", zh="后方"),
    Bilingual(en="behind on the right", zh="右后方"),
    Bilingual(en="right", zh="右侧"),
    Bilingual(en="ahead on the right", zh="右前方"),
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


def listed(names: tuple[Bilingual, ...]) -> Bilingual:
    """Return names as a list, each once: ``ahead, left and behind``."""
    once = tuple(dict.fromkeys(names))
    en = [name.en for name in once]
    last = f" and {en[-1]}" if len(en) > 1 else ""
    return Bilingual(
        en=f"{', '.join(en[:-1])}{last}" if last else en[0],
        zh="、".join(name.zh for name in once),
    )
