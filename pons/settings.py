"""Read where things are, once: environment first, then the checkout's defaults. Stdlib only.

``pons stop`` imports this, so it must stay light.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[1]
DEFAULT_HOST = "127.0.0.1"
DEFAULT_PORT = 8420


@dataclass(frozen=True, slots=True)
class Settings:
    """Say where state, robot and site are, and where the planner answers."""

    home: Path
    robot: Path
    site: Path
    host: str
    port: int
    metal: Path | None = None
    """What the simulated robot is really like, where robot.toml is to be wrong about it."""

    @property
    def url(self) -> str:
        """Return the base URL of page and API."""
        return f"http://{self.host}:{self.port}"


class BadSetting(Exception):
    """A setting cannot be used; nothing was started."""


def load(*, forgiving: bool = False) -> Settings:
    """Read PONS_HOME, PONS_ROBOT, PONS_SITE, PONS_HOST, PONS_PORT and PONS_METAL.

    Args:
        forgiving: take the default port in place of a bad one, for who only wants to stop.

    Raises:
        BadSetting: the port is no port.
    """
    given = os.environ
    return Settings(
        home=Path(given.get("PONS_HOME", ".pons")).absolute(),
        robot=Path(given.get("PONS_ROBOT", CHECKOUT / "robot.toml")).absolute(),
        site=Path(given.get("PONS_SITE", CHECKOUT / "sites" / "home")).absolute(),
        host=given.get("PONS_HOST", DEFAULT_HOST),
        port=_port(given.get("PONS_PORT", str(DEFAULT_PORT)), forgiving=forgiving),
        metal=Path(metal).absolute() if (metal := given.get("PONS_METAL")) else None,
    )


def _port(text: str, *, forgiving: bool) -> int:
    try:
        return port_of(text)
    except BadSetting:
        if not forgiving:
            raise
        return DEFAULT_PORT


def port_of(text: str) -> int:
    """Return the number of a TCP port.

    Raises:
        BadSetting: it is none.
    """
    if text.isdecimal() and 1 <= int(text) <= 65_535:
        return int(text)
    raise BadSetting(f"bad_port: the port is {text!r}; expected a number from 1 to 65535")
