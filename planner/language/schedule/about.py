"""Read words about the standing orders that are kept, in either language. Pure."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.schedule import chinese_about, english_about
from planner.language.schedule.command import CorrectOrder

if TYPE_CHECKING:
    from planner.language.schedule.command import ChangeOrders, ListOrders

_BY_ID = re.compile(r"(?:change order|更改任务) ?(?P<id>o\d{1,6}) ?: ?(?P<rest>.+)")
"""How an offered sentence names its order: "change order o3: make it nine"."""


def read_about(folded: str, *, chinese: bool) -> ListOrders | ChangeOrders | None:
    """Return a question, or which orders are removed, paused, resumed or left out on a day."""
    if chinese:
        return chinese_about.read_asked(folded) or chinese_about.read_change(folded)
    return english_about.read_asked(folded) or english_about.read_change(folded)


def read_correction(folded: str, *, chinese: bool) -> CorrectOrder | ChangeOrders | None:
    """Return the change of an order that a sentence is; None where it is none."""
    by_id = _BY_ID.fullmatch(folded)
    words = folded if by_id is None else by_id["rest"]
    read = chinese_about.read_correction if chinese else english_about.read_correction
    found = read(words)
    if by_id is None or found is None:
        return found
    if isinstance(found, CorrectOrder):
        return replace(found, which=by_id["id"], is_sure=True)
    return replace(found, which=by_id["id"], is_sure=True, is_spoken=False)
