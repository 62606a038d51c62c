"""Give the planner a certificate of this robot's own: ``pons tls`` and ``pons up --tls``.

Knows this machine's names and addresses; the authority signs for them.
"""

from __future__ import annotations

import fcntl
import socket
import struct
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from pons.authority import IssuedCertificate, issue
from pons.settings import allowed_hosts
from wire import ConfigError

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

REFUSED = 2
ANYWHERE = frozenset({"0.0.0.0", "::", ""})
_ADDRESS_OF_INTERFACE = 0x8915  # Linux's SIOCGIFADDR
_INET6 = Path("/proc/net/if_inet6")


def run(settings: LaunchSettings) -> int:
    """Run ``pons tls``: make or renew certificates that are due, and name the one to trust."""
    try:
        issued = prepare(settings)
    except ConfigError as wrong:
        print(f"pons tls: {wrong}", file=sys.stderr)
        return REFUSED
    for line in issued.trust_lines():
        print(line)
    return 0


def prepare(settings: LaunchSettings) -> IssuedCertificate:
    """Return this robot's certificate, made or renewed where it must be.

    Raises:
        ConfigError: see ``issue``.
    """
    machine = socket.gethostname().partition(".")[0].lower() or "localhost"
    asked = {settings.host, *allowed_hosts()} - ANYWHERE
    found = {"localhost", "127.0.0.1", "::1", machine, f"{machine}.local", *_addresses()}
    found.add(socket.gethostname().lower())
    return issue(settings.home, machine, asked, found, datetime.now(UTC))


def _addresses() -> set[str]:
    """Return the addresses of this machine's interfaces; on a kernel that tells none, none."""
    found = set()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asking:
        for _, name in socket.if_nameindex():
            try:
                request = struct.pack("256s", name.encode()[:15])
                answer = fcntl.ioctl(asking.fileno(), _ADDRESS_OF_INTERFACE, request)
            except OSError:
                continue  # it has no IPv4 address
            found.add(socket.inet_ntoa(answer[20:24]))
    try:
        lines = _INET6.read_text("ascii").splitlines()
    except OSError:
        return found
    packed = (bytes.fromhex(line.partition(" ")[0]) for line in lines)
    return found | {socket.inet_ntop(socket.AF_INET6, address) for address in packed}
