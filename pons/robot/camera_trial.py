"""Try a camera: is the picture this camera's, live, and the right way round?

A person holds a hand at the left of what the camera sees, then covers the lens. A picture that is
another camera's or frozen does not follow; one that hangs upside down or is mirrored shows the hand
at the right, and would send the robot to the wrong side of what it sees.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from pons.robot.trial_parties import TrialRefusal
from sensors.camera.lens_view import LensView

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from sensors.camera.shot import CameraShot
    from wire import CameraConfig

LOOKS = 5
"""Pictures a look."""
DARK = 12.0
"""Mean grey of 255, below which a picture shows nothing: a lid, or no light."""
LEAST_SHARE, MOST_SHARE = 0.02, 0.7
"""Of the picture that a hand covers; where more changed, light or robot were moved."""
OFF_MIDDLE = 0.1
"""Of half the picture's width; nearer to its middle a hand is at neither side."""
COVERED_LIGHT, COVERED_DETAIL = 0.6, 0.4
"""A covered lens lets less than this share of light or of detail through; one is enough, for
cameras brighten what is dark."""


def try_camera(
    config: CameraConfig, look: Callable[[], Sequence[CameraShot]], ask: Callable[[str], None]
) -> str:
    """Have a person hold a hand at the left, then cover the lens; return what was seen.

    Args:
        config: [camera] of robot.toml.
        look: returns ``LOOKS`` pictures of now, as the robot uses them.
        ask: asks for something to be done, and returns when it is.

    Raises:
        TrialRefusal: ``camera_dark``, ``camera_nothing``, ``camera_turned`` or
            ``camera_uncovered``; or what ``look`` raises.
    """
    ask("camera_clear")
    empty = LensView.of_shots(look())
    if not empty.light >= DARK:
        raise TrialRefusal("camera_dark", f"mean {empty.light:.0f} of 255")
    ask("camera_left")
    share, where = empty.find_change(LensView.of_shots(look()))
    if not LEAST_SHARE <= share <= MOST_SHARE:
        raise TrialRefusal("camera_nothing", f"{share:.0%} of the picture changed")
    if not abs(where) >= OFF_MIDDLE:
        raise TrialRefusal("camera_nothing", f"what changed is in the middle ({where:+.0%})")
    if where > 0.0:
        found = f"seen {where:+.0%} from the middle; upside_down is {config.upside_down}"
        raise TrialRefusal("camera_turned", found)
    ask("camera_cover")
    light, detail = empty.let_through(LensView.of_shots(look()))
    if not (light <= COVERED_LIGHT or detail <= COVERED_DETAIL):
        raise TrialRefusal("camera_uncovered", f"{light:.0%} of the light, {detail:.0%} of detail")
    width, height = empty.size
    return f"{width} x {height}, {where:+.0%}, {light:.0%}"
