"""Repeat a request until the bridge answers it, as the wire asks of stops and operators.

Told the tick; knows no time and no content.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from tools.lockstep.latencies import Pace
from wire import Answer, Status


@dataclass(slots=True)
class Request:
    """Follow one request to its verdict."""

    id: str
    kind: str
    say: Callable[[], None]
    began: int
    answer: Answer | None = None


class RequestRetry:
    """Keep what is being asked."""

    def __init__(self, pace: Pace) -> None:
        self._pace = pace
        self._open: list[Request] = []

    @property
    def asks(self) -> bool:
        """Tell whether an answer is awaited."""
        return bool(self._open)

    def ask(self, kind: str, request_id: str, say: Callable[[], None], tick: int) -> Request:
        """Say something from now on; its answer appears in what is returned."""
        request = Request(request_id, kind, say, tick)
        self._open.append(request)
        say()
        return request

    def hear(self, status: Status) -> None:
        """Find answers in a status."""
        for request in self._open:
            for answer in status.answers:
                if answer.id == request.id:
                    request.answer = answer
        self._open = [request for request in self._open if request.answer is None]

    def tick(self, tick: int) -> None:
        """Repeat what is due, forget what nobody answered in time."""
        self._open = [one for one in self._open if tick - one.began <= self._pace.give_up]
        for request in self._open:
            waited = tick - request.began
            if waited > 0 and waited % self._pace.repeat == 0:
                request.say()
