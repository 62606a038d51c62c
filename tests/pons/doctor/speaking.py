"""Be a process of a running robot that says the same again and again."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from wire import Record
from wire.keys import Key, Party
from wire.session import open_session


@contextmanager
def speaking(party: Party, home: Path, *said: tuple[Key[Any], Record]) -> Iterator[None]:
    ending = threading.Event()
    with open_session(party, "r1", home) as session:
        publishers = [(session.publisher(key), message) for key, message in said]

        def say() -> None:
            while not ending.wait(0.02):
                for publisher, message in publishers:
                    publisher.put(message)

        thread = threading.Thread(target=say, daemon=True)
        thread.start()
        try:
            yield
        finally:
            ending.set()
            thread.join()
