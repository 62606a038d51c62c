"""Be the part of a bridge that an operator's shell meets: it says its status and answers."""

from __future__ import annotations

import signal
import sys
import threading
from pathlib import Path

from tests.wire.examples import EXAMPLES
from wire import Answer, OpRequest, Status, Stop
from wire.keys import OPS, STATUS, STOP, Party
from wire.session import open_session

PERIOD_S = 0.02


class StandingBridge(threading.Thread):
    """Accept every request of one robot and keep what was asked, until closed."""

    def __init__(self, home: Path, robot_id: str, *, virtual: bool = True) -> None:
        super().__init__(daemon=True)
        self._session = open_session(Party.BRIDGE, robot_id, home)
        self._ears = {key.path: self._session.subscriber(key) for key in (STOP, *OPS)}
        self._mouth = self._session.publisher(STATUS)
        example = EXAMPLES[Status]
        assert isinstance(example, Status)
        drive = example.drive.model_copy(update={"virtual": virtual})
        self._status = example.model_copy(update={"robot": robot_id, "answers": (), "drive": drive})
        self._over = threading.Event()
        self.asked: list[str] = []
        """The path of each request, once for each id."""
        self.sources: set[str] = set()
        """Who asked, as they said."""

    @property
    def nonce(self) -> str:
        """Return what proofs are made for."""
        return self._status.nonce

    def run(self) -> None:
        answers: dict[str, Answer] = {}
        while not self._over.wait(PERIOD_S):
            for path, ears in self._ears.items():
                kind = path.split("/")[1]
                for item in ears.drain().items:
                    if isinstance(item, Stop | OpRequest) and item.id not in answers:
                        answers[item.id] = Answer.model_validate(
                            {"id": item.id, "kind": kind, "accepted": True, "code": "ok",
                             "detail": ""}
                        )  # fmt: skip
                        self.asked.append(path)
                        self.sources.add(item.source)
            newest = tuple(answers.values())[-4:]
            self._mouth.put(self._status.model_copy(update={"answers": newest}))

    def __enter__(self) -> StandingBridge:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self.join()
        self._session.close()


def main(arguments: list[str]) -> int:
    """Be one until SIGTERM: home and robot; then tell what was asked."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    with StandingBridge(Path(arguments[0]), arguments[1]) as bridge:
        print("speaks", flush=True)
        signal.sigwait([signal.SIGTERM])
    print(*bridge.asked, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
