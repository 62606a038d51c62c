"""Connect to a server that the owner named, and say why not. Nothing is sent."""

from __future__ import annotations

import socket

from planner.outbound.address import Address, refused_among

CONNECT_S = 3.0


def trouble_reaching(address: Address) -> str | None:
    """Return why the server of an address can't be reached, or None where it can."""
    try:
        found = socket.getaddrinfo(address.host, address.port, type=socket.SOCK_STREAM)
        refused = refused_among([str(one[4][0]) for one in found])
        if refused is not None:
            return f"leads to {refused}, which is never asked"
        socket.create_connection((address.host, address.port), CONNECT_S).close()
    except OSError as error:
        return error.strerror or str(error)
    return None
