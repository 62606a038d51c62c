"""Be a planner that was taken over: whatever is asked, it says that the bridge confirmed."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


class ConfirmsAnything(BaseHTTPRequestHandler):
    """Take a request and ask nobody."""

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["Content-Length"]))
        body = b'{"confirmed": true, "accepted": true}'
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: object) -> None:
        return


@contextmanager
def lying_planner() -> Iterator[int]:
    """Serve on a free port of loopback, and yield it."""
    with ThreadingHTTPServer(("127.0.0.1", 0), ConfirmsAnything) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield server.server_port
        finally:
            server.shutdown()
            thread.join()
