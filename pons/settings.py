"""Read where things are, once: environment first, then the defaults. Stdlib only.

``pons stop`` imports this, so it must stay light.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from pons_assets import DEFAULT_SITE, ROBOT_FILE, ROOT, SITES

CHECKOUT = ROOT
"""Where tests and tools find robot.toml and sites."""
DEFAULT_HOST = "127.0.0.1"
DEFAULT_PORT = 8420
PLANNER_MARK = Path("run") / "planner" / "speaks.tls"
"""There while this home's planner speaks TLS (planner/tls.py)."""
_HERE = {"0.0.0.0": "127.0.0.1", "::": "::1"}


@dataclass(frozen=True, slots=True)
class LaunchSettings:
    """Say where state, robot and site are, and where the planner answers."""

    home: Path
    robot: Path
    site: Path
    host: str
    port: int
    metal: Path | None = None
    """What the simulated robot is really like, where robot.toml is to be wrong about it."""
    domain: str | None = None
    """How the simulated home is worse than described: ``random``, or a file (sim/domain.py)."""
    seed: int | None = None
    """Of that, and of the simulator's noise."""
    twin: bool = False
    """Whether a base of metal is to be played by its twin (docs/drives.md)."""
    twin_firmware: Path | None = None
    """The build of our own firmware that the twin of a base is to run (docs/firmware.md)."""
    mapping: str | None = None
    """Of the site that is being mapped; its canvas takes the site's place for all but the simulator
    (docs/mapping.md)."""
    set_up: bool = False
    """Whether to begin in set-up, though the robot was tried (docs/robot-try.md)."""
    tls: bool = False
    """Whether the planner is asked, and by ``pons up`` started, over TLS."""
    authority: Path | None = None
    """The certificate to judge the planner's by, in place of ``$PONS_HOME/tls/ca.crt``."""

    @property
    def canvas(self) -> Path | None:
        """Return the folder in which a map grows; None where none does."""
        return None if self.mapping is None else self.home / "mapping" / self.mapping

    @property
    def host_to_dial(self) -> str:
        """Return the host to ask: a planner that listens everywhere is asked here."""
        return _HERE.get(self.host, self.host)

    @property
    def url(self) -> str:
        """Return the base URL of page and API."""
        host = f"[{self.host_to_dial}]" if ":" in self.host_to_dial else self.host_to_dial
        return f"{'https' if self.tls else 'http'}://{host}:{self.port}"


class BadSetting(Exception):
    """A setting cannot be used; nothing was started."""


def load(*, forgiving: bool = False) -> LaunchSettings:
    """Read PONS_HOME, _ROBOT, _SITE, _HOST, _PORT, _METAL, _TLS and _CA.

    Args:
        forgiving: take the default in place of a bad port or PONS_TLS, for who only wants to stop.

    Raises:
        BadSetting: the port is no port, or PONS_TLS neither 0 nor 1.
    """
    given = os.environ
    home = Path(given.get("PONS_HOME", ".pons")).absolute()
    return LaunchSettings(
        home=home,
        robot=Path(given.get("PONS_ROBOT", ROBOT_FILE)).absolute(),
        site=site_of(given.get("PONS_SITE", str(DEFAULT_SITE)), home),
        host=given.get("PONS_HOST", DEFAULT_HOST),
        port=_port(given.get("PONS_PORT", str(DEFAULT_PORT)), forgiving=forgiving),
        metal=Path(metal).absolute() if (metal := given.get("PONS_METAL")) else None,
        tls=_tls(given.get("PONS_TLS", ""), home, forgiving=forgiving),
        authority=Path(ca).absolute() if (ca := given.get("PONS_CA")) else None,
    )


def site_of(given: str, home: Path) -> Path:
    """Return a site's folder, by its path or by its name: an imported one before a shipped one."""
    folders = (Path(given), home / "sites" / given, SITES / given)
    there = (folder for folder in folders if os.path.isdir(folder))  # noqa: PTH112  # as above
    return next(there, folders[0]).absolute()


def _tls(text: str, home: Path, *, forgiving: bool) -> bool:
    if text in ("0", "1"):
        return text == "1"
    if text and not forgiving:
        raise BadSetting(f"bad_tls: PONS_TLS is {text!r}; expected 1 for https or 0 for http")
    return os.path.exists(home / PLANNER_MARK)  # noqa: PTH110  # Path's raises in a closed folder


def allowed_hosts() -> set[str]:
    """Return the names, beside the planner's address, that its owner lets it be asked by."""
    given = os.environ.get("PONS_ALLOWED_HOSTS", "")
    return {word.strip() for word in given.split(",") if word.strip()}


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
