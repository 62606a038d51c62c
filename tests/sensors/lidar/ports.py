"""Hold a port in memory, whose far end a test or a twin's firmware plays."""

from __future__ import annotations

from devices import PortTrouble


class MemoryPort:
    """Be read and written without a line; a test puts bytes in and takes requests out."""

    def __init__(self) -> None:
        self.opened = 1
        self.trouble: PortTrouble | None = None
        self.coming = bytearray()
        self.requests: list[bytes] = []

    def read(self) -> bytes:
        data = bytes(self.coming[:4096])
        del self.coming[:4096]
        return data

    def write(self, data: bytes) -> bool:
        self.requests.append(data)
        return self.trouble is None

    def take_requests(self) -> bytes:
        data = b"".join(self.requests)
        self.requests.clear()
        return data
