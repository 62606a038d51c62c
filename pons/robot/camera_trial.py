"""Try a camera: is the picture this camera's, live, and the right way round?

A person holds a hand at the left of what the camera sees, then covers the lens. A picture that is
another camera's or frozen does not follow; one that hangs upside down or is mirrored shows the hand
at the right, and would send the robot to the wrong side of what it sees.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np

from pons.robot.trial_parties import TrialRefusal

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from wire import CameraConfig

    Floats = NDArray[np.float64]
    Pictures = Sequence[NDArray[np.uint8]]

LOOKS = 5
"""Pictures a look: their median has no passing noise."""
_GRID = (64, 48)
DARK = 12.0
"""Mean grey of 255, below which a picture shows nothing: a lid, or no light."""
CHANGED, TIMES_NOISE = 20.0, 4.0
"""A cell of the picture changed by so many greys, and so many times its own noise."""
LEAST_SHARE, MOST_SHARE = 0.02, 0.7
"""Of the picture that a hand covers; where more changed, light or robot were moved."""
OFF_MIDDLE = 0.1
"""Of half the picture's width; nearer to its middle a hand is at neither side."""
COVERED_LIGHT, COVERED_DETAIL = 0.6, 0.4
"""A covered lens lets less than this share of light or of detail through; one is enough, for
cameras brighten what is dark."""


def try_camera(
    config: CameraConfig, look: Callable[[], Pictures], ask: Callable[[str], None]
) -> str:
    """Have a person hold a hand at the left, then cover the lens; return what was seen.

    Args:
        config: [camera] of robot.toml.
        look: returns ``LOOKS`` pictures of now, as the robot uses them: shape (rows, columns, 3).
        ask: asks for something to be done, and returns when it is.

    Raises:
        TrialRefusal: ``camera_dark``, ``camera_nothing``, ``camera_turned`` or
            ``camera_uncovered``; or what ``look`` raises.
    """
    ask("camera_clear")
    pictures = look()
    empty = _greys(pictures)
    before = np.median(empty, axis=0)
    if not before.mean() >= DARK:
        raise TrialRefusal("camera_dark", f"mean {before.mean():.0f} of 255")
    ask("camera_left")
    where = _find_side(before, empty.std(axis=0), np.median(_greys(look()), axis=0))
    if where > 0.0:
        found = f"seen {where:+.0%} from the middle; upside_down is {config.upside_down}"
        raise TrialRefusal("camera_turned", found)
    ask("camera_cover")
    light, detail = _let_through(before, np.median(_greys(look()), axis=0))
    if not (light <= COVERED_LIGHT or detail <= COVERED_DETAIL):
        raise TrialRefusal("camera_uncovered", f"{light:.0%} of the light, {detail:.0%} of detail")
    height, width = pictures[0].shape[:2]
    return f"{width} x {height}, {where:+.0%}, {light:.0%}"


def _greys(pictures: Pictures) -> Floats:
    """Return pictures as grey grids, shape (pictures, rows, columns)."""
    return np.stack(
        [
            cv2.resize(
                cv2.cvtColor(each, cv2.COLOR_BGR2GRAY), _GRID, interpolation=cv2.INTER_AREA
            ).astype(np.float64)
            for each in pictures
        ]
    )


def _find_side(before: Floats, noise: Floats, now: Floats) -> float:
    """Return where something came into the picture: -1 at its left edge, 1 at its right one."""
    # What did not change tells by how much the camera has changed its exposure meanwhile.
    gain = float(np.median(now / np.maximum(before, 1.0)))
    changed = np.abs(now - gain * before) > np.maximum(CHANGED, TIMES_NOISE * noise)
    share = float(changed.mean())
    if not LEAST_SHARE <= share <= MOST_SHARE:
        raise TrialRefusal("camera_nothing", f"{share:.0%} of the picture changed")
    columns = np.nonzero(changed)[1]
    where = float(np.median(columns)) / (_GRID[0] - 1) * 2.0 - 1.0
    if not abs(where) >= OFF_MIDDLE:
        raise TrialRefusal("camera_nothing", f"what changed is in the middle ({where:+.0%})")
    return where


def _let_through(before: Floats, now: Floats) -> tuple[float, float]:
    """Return the shares of light and of detail that a lens still lets through."""
    light = float(now.mean() / before.mean())
    detail = _detail(now) / max(_detail(before), 1e-9)
    return light, detail


def _detail(grid: Floats) -> float:
    smooth = cv2.GaussianBlur(grid, (5, 5), 0.0)
    return float(np.abs(np.diff(smooth, axis=0)).mean() + np.abs(np.diff(smooth, axis=1)).mean())
