"""Refuse what can't be a standing order: a stable code, and a sentence in both languages."""

from __future__ import annotations

from planner.language.catalogue import message, say
from planner.plan import Bilingual, Code, Refuse


class OrderRefusal(Exception):
    """A standing order can't be taken, or there is none of that id. Nothing has changed."""

    def __init__(self, code: str, detail: str, **facts: str | float | Bilingual) -> None:
        """Take the code, the details for a log, and the facts that the sentence needs."""
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail
        self.message = say(f"order_refusal.{code}", **facts)

    @property
    def plan(self) -> Refuse:
        """Return it as what a goal comes to."""
        return Refuse(
            code=Code.ORDER_NOT_KEPT, reason=message(Code.ORDER_NOT_KEPT, why=self.message)
        )
