"""Find the files that are not Python: robot.toml, sites, prompts, the built page, the lock.

They lie in two places: beside the packages in a checkout, and in this very package where a wheel
was installed (setup.py puts them there). This is the one module that knows. Standard library only,
because ``pons stop`` and the smallest process import it; docs/adr/0035.
"""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
IS_INSTALLED = (_PACKAGE / "robot.toml").is_file()
"""True in a wheel's environment, false in a checkout, an editable install included."""
ROOT = _PACKAGE if IS_INSTALLED else _PACKAGE.parent
ROBOT_FILE = ROOT / "robot.toml"
"""The default robot. An installed one belongs to the package: copy it before changing it."""
ROBOTS = ROOT / "robots"
"""A robot.toml for each base that a drive speaks to."""
COMMIT_FILE = _PACKAGE / "commit"
"""The commit that a wheel was built from, where the builder knew it."""
SITES = ROOT / "sites"
DEFAULT_SITE = SITES / "home"
PROMPTS = ROOT / "prompts"
PAGE = ROOT / "page" if IS_INSTALLED else ROOT / "web" / "dist"
"""The built page; a checkout has none before ``make page``."""
ROS2_NODE = ROOT / ("pons_ros2" if IS_INSTALLED else "ros2/pons_ros2")
"""The ROS 2 package that runs on a robot of ROS 2, to be built by colcon there."""
LOCK = ROOT / "requirements.lock"
"""The versions, with hashes, that this version was tested with."""


class NeedsCheckout(SystemExit):
    """Something is asked that only a checkout can do; ends the command with exit status 1."""


def checkout(purpose: str) -> Path:
    """Return the root of the checkout that this code runs from.

    Args:
        purpose: what needs it, as the subject of a sentence.

    Raises:
        NeedsCheckout: ``needs_checkout``: this is an installed wheel.
    """
    if IS_INSTALLED:
        raise NeedsCheckout(needs_checkout(purpose))
    return ROOT


def needs_checkout(purpose: str) -> str:
    """Return the message of ``needs_checkout``: the code, what was asked, what to do."""
    return (
        f"needs_checkout: {purpose} needs a checkout of Pons, and this one was installed from a "
        "wheel; clone the repository and run it there"
    )
