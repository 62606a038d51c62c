"""Be a model's server on a real socket that says exactly the bytes of a script to each caller."""

from __future__ import annotations

import contextlib
import json
import shutil
import socket
import ssl
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

Script = Callable[[socket.socket], None]
CHUNK = b"a" * 65_536
END_S = 20.0


class Wire:
    """Hold a listening server's address and what it has been sent."""

    def __init__(self, port: int) -> None:
        self.port = port
        self.asked: list[bytes] = []
        self.ending = threading.Event()


@contextmanager
def serving(script: Script, context: ssl.SSLContext | None = None) -> Iterator[Wire]:
    """Serve until the block ends, each connection in a thread of its own."""
    with socket.create_server(("127.0.0.1", 0)) as ears:
        wire = Wire(int(ears.getsockname()[1]))
        threads: list[threading.Thread] = []
        connections: list[socket.socket] = []

        def accept() -> None:
            while True:
                connection, _ = ears.accept()
                connections.append(connection)
                if wire.ending.is_set():  # who rings now only wakes us
                    return
                one = threading.Thread(target=answer, args=(connection,))
                one.start()
                threads.append(one)

        def answer(connection: socket.socket) -> None:
            with contextlib.suppress(OSError), contextlib.closing(connection):
                connection.settimeout(END_S)
                if context is not None:
                    connection = context.wrap_socket(connection, server_side=True)
                wire.asked.append(_request(connection))
                script(connection)

        keeper = threading.Thread(target=accept)
        keeper.start()
        try:
            yield wire
        finally:
            wire.ending.set()
            socket.create_connection(("127.0.0.1", wire.port)).close()
            keeper.join(END_S)
            for connection in connections:
                with contextlib.suppress(OSError):  # a thread may have closed it
                    connection.shutdown(socket.SHUT_RDWR)
            for thread in threads:
                thread.join(END_S)
            for connection in connections:
                connection.close()


def _request(connection: socket.socket) -> bytes:
    """Read one request to its end."""
    data = bytearray()
    while b"\r\n\r\n" not in data:
        got = connection.recv(65_536)
        if not got:
            return bytes(data)
        data += got
    head, _, body = bytes(data).partition(b"\r\n\r\n")
    lengths = [line for line in head.lower().split(b"\r\n") if line.startswith(b"content-length:")]
    left = int(lengths[0].split(b":")[1]) - len(body) if lengths else 0
    while left > 0:
        got = connection.recv(min(left, 65_536))
        left = left - len(got) if got else 0
    return bytes(data)


def said(*parts: bytes, pause_s: float = 0.0) -> Script:
    """Send these bytes and close."""

    def script(connection: socket.socket) -> None:
        for part in parts:
            connection.sendall(part)
            time.sleep(pause_s)

    return script


def without_end(first: bytes, again: bytes, pause_s: float = 0.0) -> Script:
    """Send the same bytes until the other side has enough."""

    def script(connection: socket.socket) -> None:
        connection.sendall(first)
        began_s = time.monotonic()
        while time.monotonic() - began_s < END_S:
            connection.sendall(again)
            time.sleep(pause_s)

    return script


def ok(body: bytes, *headers: bytes) -> bytes:
    """Return a whole answer with status 200."""
    lines = (b"HTTP/1.1 200 OK", b"Content-Type: application/json", *headers)
    return b"\r\n".join((*lines, b"Content-Length: %d" % len(body), b"", body))


def completion(text: str) -> bytes:
    """Return a whole answer in which the model wrote a text."""
    choice = {"message": {"role": "assistant", "content": text}}
    return ok(json.dumps({"choices": [choice]}).encode())


def self_signed(folder: Path) -> ssl.SSLContext | None:
    """Return a server's context with a certificate of its own making; None without openssl."""
    tool = shutil.which("openssl")
    if tool is None:
        return None
    key, certificate = folder / "key.pem", folder / "certificate.pem"
    words = ["req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
             "-days", "2", "-subj", "/CN=127.0.0.1", "-addext", "subjectAltName=IP:127.0.0.1",
             "-keyout", str(key), "-out", str(certificate)]  # fmt: skip
    subprocess.run([tool, *words], check=True, capture_output=True)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(certificate, key)
    return context
