"""List the serial ports of this machine and what the kernel tells of each, without opening one.

Read from /sys/class/tty, /dev/serial/by-id and by-path, and /proc. A program's open files are
visible to its own user and to root alone, so an empty ``holders`` does not prove a port free.
"""

from __future__ import annotations

import contextlib
import grp
import os
import stat
from dataclasses import dataclass
from pathlib import Path

ROOT = Path("/")
_PHANTOM_TYPE = "0"
"""Of a ttyS* that the 8250 driver keeps ready though no such chip is there."""
_GROUP_MAY = stat.S_IRGRP | stat.S_IWGRP
_NO_DEVICE = ("rfcomm", "ttyprintk")
PORT_TAKERS = ("brltty", "gpsd", "ModemManager")
"""brltty takes adapters that braille displays use, too, and no port is left; gpsd opens what may be
a receiver; ModemManager questions what may be a modem."""


@dataclass(frozen=True, slots=True)
class UsbIdentity:
    """Name the USB device behind a port, as its own descriptors say."""

    vendor: str
    """Four hex digits, as the product."""
    product: str
    maker: str
    name: str
    serial: str


@dataclass(frozen=True, slots=True)
class PortHolder:
    """Name a process that has a port open."""

    pid: int
    command: str


@dataclass(frozen=True, slots=True)
class SerialPortEntry:
    """Hold what is known of one port before anybody opens it."""

    path: Path
    lasting: Path
    """The name that outlives plugging: below by-id, or by-path where several adapters call
    themselves alike; the path itself where there is none."""
    usb: UsbIdentity | None
    driver: str
    is_console: bool
    """The kernel talks here, or a login waits: no robot's device."""
    group: str
    """May read and write it, root apart; empty where none but root may."""
    is_permitted: bool
    holders: tuple[PortHolder, ...]
    twins: tuple[Path, ...] = ()
    """Other ports whose USB device has the same vendor, product and serial number."""


def list_ports(root: Path = ROOT) -> list[SerialPortEntry]:
    """Return the ports that have a device behind them, by name."""
    folder = root / "sys/class/tty"
    names = sorted(entry.name for entry in folder.iterdir()) if folder.is_dir() else []
    found = [name for name in names if _has_device(folder / name)]
    identities = {name: read_usb(folder / name) for name in found}
    consoles = set(_text(folder / "console/active").split())
    entries = []
    for name in found:
        mine = identities[name]
        alike = [
            root / "dev" / other
            for other in found
            if other != name and mine is not None and identities[other] == mine
        ]
        entries.append(_entry(root, root / "dev" / name, mine, tuple(alike), name in consoles))
    return entries


def describe_port(path: Path, root: Path = ROOT) -> SerialPortEntry:
    """Return what is known of a port that a person named, a link or a pseudo-terminal too."""
    name = path.resolve().name
    folder = root / "sys/class/tty"
    consoles = set(_text(folder / "console/active").split())
    mine = read_usb(folder / name)
    return _entry(root, path, mine, (), name in consoles)


def read_usb(tty: Path) -> UsbIdentity | None:
    """Return the USB device that a tty of sysfs hangs on; None where it hangs on none."""
    with contextlib.suppress(OSError):
        at = (tty / "device").resolve(strict=True)
        for folder in (at, *at.parents):
            if (folder / "idVendor").is_file():
                return UsbIdentity(
                    *(
                        _text(folder / key)
                        for key in ("idVendor", "idProduct", "manufacturer", "product", "serial")
                    )
                )
    return None


def find_holders(path: Path, root: Path = ROOT) -> tuple[PortHolder, ...]:
    """Return the processes that have a port open, as far as this user may see them."""
    real = path.resolve()
    found = []
    for folder in (root / "proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # another user's, or it has just ended
            if any(Path(link).resolve() == real for link in _links(folder / "fd")):
                found.append(PortHolder(int(folder.name), _command(folder)))
    return tuple(found)


def find_port_takers(root: Path = ROOT) -> tuple[str, ...]:
    """Return which programs run here that take new ports for something else, by name."""
    running = {_text(folder / "comm") for folder in (root / "proc").glob("[0-9]*")}
    return tuple(name for name in PORT_TAKERS if name in running)


def _entry(
    root: Path,
    path: Path,
    usb: UsbIdentity | None,
    alike: tuple[Path, ...],
    is_console: bool,
) -> SerialPortEntry:
    driver = root / "sys/class/tty" / path.resolve().name / "device/driver"
    return SerialPortEntry(
        path=path,
        lasting=_lasting_name(root, path, among_alike=bool(alike)),
        usb=usb,
        driver=driver.resolve().name if driver.exists() else "",
        is_console=is_console,
        group=_group(path),
        is_permitted=os.access(path, os.R_OK | os.W_OK, effective_ids=True),
        holders=find_holders(path, root) if _is_terminal(root, path) else (),
        twins=alike,
    )


def _lasting_name(root: Path, path: Path, *, among_alike: bool) -> Path:
    """Return the best name; two alike share one name below by-id, which is then no name."""
    folders = ("by-path",) if among_alike else ("by-id", "by-path")
    for folder in folders:
        for link in sorted((root / "dev/serial" / folder).glob("*")):
            if link.resolve() == path.resolve():
                return link
    return path


def _has_device(tty: Path) -> bool:
    if not (tty / "device").exists() or tty.name.startswith(_NO_DEVICE):
        return False
    return not (tty.name.startswith("ttyS") and _text(tty / "type") == _PHANTOM_TYPE)


def _is_terminal(root: Path, path: Path) -> bool:
    """Tell a serial port from another device, which programs hold that are no affair of ours."""
    real = path.resolve()
    return (root / "sys/class/tty" / real.name).exists() or real.is_relative_to(root / "dev/pts")


def _group(path: Path) -> str:
    try:
        found = path.stat()
        name = grp.getgrgid(found.st_gid).gr_name
    except (OSError, KeyError):
        return ""
    return name if found.st_mode & _GROUP_MAY == _GROUP_MAY and found.st_gid else ""


def _links(folder: Path) -> list[str]:
    found = []
    for link in folder.iterdir():
        with contextlib.suppress(OSError):  # it has just been closed
            found.append(os.readlink(link))  # noqa: PTH115  # a Path costs more
    return found


def _command(folder: Path) -> str:
    text = (folder / "cmdline").read_bytes().decode("utf-8", "replace").strip("\0")
    program, *words = text.split("\0")  # without its folder: what it does is what a person knows
    return " ".join([program.rpartition("/")[2], *words])[:80] or _text(folder / "comm")


def _text(path: Path) -> str:
    """Return a short file's text; nothing where it can't be read."""
    try:
        return path.read_text("utf-8", "replace").strip()
    except OSError:
        return ""
