"""Keep an order whose time is missing until a person says it: "remind me to ring the doctor".

The time may come as an answer to the question, or said as a sentence of its own ("about ten
tomorrow"). Laws: what was asked longer ago than ``WAITS_S`` is finished by nothing; a remark that
holds a time ("we have guests tonight") finishes nothing, only a time that is said by itself does.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner.language.catalogue import say
from planner.language.folding import has_chinese
from planner.language.schedule import ScheduleCommand, complete_order
from planner.language.schedule.reasons import is_reason
from planner.plan import Clarify, Code, Option

WAITS_S = 600.0
_CLAUSE = re.compile(r"[,，;；、]")
MISSING = "order_time_missing"


@dataclass(slots=True)
class UnfinishedOrder:
    """Hold the newest order that was asked about, and when that was."""

    command: ScheduleCommand | None = None
    asked_unix_s: float = float("-inf")

    def ask(self, command: ScheduleCommand, now_unix_s: float) -> Clarify | None:
        """Return the question about an order that can't be kept as it was said; None: none helps.

        Args:
            command: what was said.
            now_unix_s: by people's clock.
        """
        if command.problem == "order_event_place":
            option = Option(label=say("standing.nearest", order=command.offer), text=command.offer)
            question = say("standing.event_place", order=command.offer)
            return Clarify(code=Code.NOT_UNDERSTOOD, question=question, options=(option,))
        if command.problem != MISSING or not command.order.strip():
            return None
        self.command, self.asked_unix_s = command, now_unix_s
        question = say("standing.when", order=command.reminder or command.order)
        return Clarify(code=Code.INCOMPLETE, question=question)

    def finish(
        self, command: ScheduleCommand, said: str | None, now_unix_s: float, sentence: str = ""
    ) -> ScheduleCommand:
        """Return an order with the time that was said for it; the same where none was.

        Args:
            command: the order, or a time that stands alone.
            said: the answer to the question about this order, if it is one.
            now_unix_s: by people's clock.
            sentence: the whole of what was said now.
        """
        if said is not None and command.problem == MISSING:
            return complete_order(command, said) or command
        order = command.order.strip().lower()
        apart = is_reason(order, chinese=has_chinese(order)) and self._has_time_apart(sentence)
        beside = not order or apart  # "after tea, at seven"; "we have guests tonight" is a remark
        alone = beside and command.reminder is None and command.problem is None
        waits = self.command is not None and 0.0 <= now_unix_s - self.asked_unix_s <= WAITS_S
        if not alone or not waits or self.command is None:
            return command
        finished = complete_order(self.command, command.words)
        if finished is None:
            return command
        self.command = None
        return finished

    def _has_time_apart(self, sentence: str) -> bool:
        """Tell whether a clause of a sentence is a time alone, and so answers the question."""
        asked = self.command
        return asked is not None and any(
            complete_order(asked, clause) is not None for clause in _CLAUSE.split(sentence)
        )
