"""Read where things are, once: environment first, then the defaults. Stdlib only.

``pons stop`` imports this, so it must stay light.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from pons_assets import DEFAULT_SITE, ROBOT_FILE, ROBOTS, ROOT, SITES

CHECKOUT = ROOT
"""Where tests and tools find robot.toml and sites."""
DEFAULT_HOST = "127.0.0.1"
DEFAULT_PORT = 8420
PLANNER_MARK = Path("run") / "planner" / "address"
"""Where this home's planner answers, as it said when it began (planner/tls.py)."""
NAMES_A_ROBOT = ("PONS_HOME", "PONS_HOST", "PONS_PORT")
"""Variables by which a person says which robot is meant."""
OWN_ROBOT = "robot.toml"
"""In ``$PONS_HOME``: the robot of this home, as ``pons robot new`` wrote it."""
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
    world: Path | None = None
    """The site that the simulator plays, where it is not ``site``: saving a map changes no home."""
    set_up: bool = False
    """Whether to begin in set-up, though the robot was tried (docs/robot-try.md)."""
    tls: bool = False
    """Whether the planner is asked, and by ``pons up`` started, over TLS."""
    authority: Path | None = None
    """The certificate to judge the planner's by, in place of ``$PONS_HOME/tls/ca.crt``."""
    owner_uid: int | None = None
    """Who runs a robot that was found, not named: its planner is told no token but ours."""
    robot_id: str = ""
    """Of a robot that was found."""

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


def load(*, forgiving: bool = False, starts: bool = False) -> LaunchSettings:
    """Read PONS_HOME, _ROBOT, _SITE, _HOST, _PORT, _METAL, _TLS and _CA.

    Where the planner's address is not given, this home's planner has said it.

    Args:
        forgiving: take the default in place of a bad port or PONS_TLS, for who only wants to stop.
        starts: whether a planner is to be started: where the last one answered is nothing to go by.

    Raises:
        BadSetting: the port is no port, or PONS_TLS neither 0 nor 1.
    """
    given = os.environ
    home = Path(given.get("PONS_HOME", ".pons")).absolute()
    said = None if starts else planner_address(home)
    scheme, host, port = said or ("http", DEFAULT_HOST, DEFAULT_PORT)
    return LaunchSettings(
        home=home,
        robot=robot_of(given.get("PONS_ROBOT", ""), home),
        site=site_of(given.get("PONS_SITE", ""), home),
        host=given.get("PONS_HOST", host),
        port=_port(given.get("PONS_PORT", str(port)), forgiving=forgiving),
        metal=Path(metal).absolute() if (metal := given.get("PONS_METAL")) else None,
        tls=_tls(given.get("PONS_TLS", ""), scheme, forgiving=forgiving),
        authority=Path(ca).absolute() if (ca := given.get("PONS_CA")) else None,
    )


def site_of(given: str, home: Path) -> Path:
    """Return a site's folder, by its path or by its name: an imported one before a shipped one.

    Without either the map that was made of this home, where a robot of its own drives; else the
    demo robot's.
    """
    if not given:
        own = home / "sites" / DEFAULT_SITE.name
        is_own = os.path.isfile(own / "map.yaml") and os.path.isfile(home / OWN_ROBOT)  # noqa: PTH113
        return own if is_own else DEFAULT_SITE
    folders = (Path(given), home / "sites" / given, SITES / given)
    there = (folder for folder in folders if os.path.isdir(folder))  # noqa: PTH112  # as above
    return next(there, folders[0]).absolute()


def robot_of(given: str, home: Path) -> Path:
    """Return a robot.toml by its path or a preset's name; without either the home's own.

    A home gets one by ``pons robot new``; the demo robot's is used where it has none.
    """
    if not given:
        own = home / OWN_ROBOT
        return own if os.path.isfile(own) else ROBOT_FILE  # noqa: PTH113  # as below
    files = (Path(given), ROBOTS / f"{given}.toml", ROBOTS.parent / given)
    named = files[:2] if "/" not in given else (files[0], files[2])
    return next((file for file in named if os.path.isfile(file)), files[0]).absolute()  # noqa: PTH113


def planner_address(home: Path) -> tuple[str, str, int] | None:
    """Return scheme, host and port that a home's planner has said; None where it said none."""
    try:
        scheme, host, port = (home / PLANNER_MARK).read_text("ascii").split()
        return (scheme, host, port_of(port)) if scheme in ("http", "https") else None
    except (OSError, ValueError, BadSetting):
        return None


def asker() -> str:
    """Return how the record names who asks from this shell: by the machine's own list of users.

    A directory service is not asked: it may be slow, and somebody wants the robot to stand.
    """
    uid = str(os.getuid())
    name = uid
    try:
        with open("/etc/passwd", encoding="utf-8", errors="replace") as users:  # noqa: PTH123
            known = {one[2]: one[0] for line in users if len(one := line.split(":")) > 2}
        name = known.get(uid, uid)
    except OSError:
        pass  # a machine without one
    fit = "".join(one for one in name if one.isascii() and (one.isalnum() or one in "_.-"))
    return f"cli:{fit[:32]}"


def is_robot_named() -> bool:
    """Return whether the environment says which robot is meant."""
    return any(os.environ.get(name) for name in NAMES_A_ROBOT)


def _tls(text: str, scheme: str, *, forgiving: bool) -> bool:
    if text in ("0", "1"):
        return text == "1"
    if text and not forgiving:
        raise BadSetting(f"bad_tls: PONS_TLS is {text!r}; expected 1 for https or 0 for http")
    return scheme == "https"


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
