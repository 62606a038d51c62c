"""Own the steps by which a model proposes something about standing orders. Data only.

No plan holds one: as a reply is read, each becomes a question whose one offer is a sentence of the
clock's own grammar (``planner.brain.endpoint.order_proposal``). So it waits for a person's yes, and
what the yes keeps is read, judged and told as if the person had said it.
"""

from __future__ import annotations

from typing import Literal

from planner.plan.base import Frozen
from planner.plan.steps import Label, Words


class OrderAdd(Frozen):
    """Propose a standing order: due "every day at 20:00". Alone."""

    kind: Literal["order_add"] = "order_add"
    due: Label
    order: Words


class OrderChange(Frozen):
    """Propose another time for the one that these words name."""

    kind: Literal["order_change"] = "order_change"
    which: Label
    due: Label


class OrderRemove(Frozen):
    """Propose to end the one that these words name."""

    kind: Literal["order_remove"] = "order_remove"
    which: Label


ORDER_STEPS: dict[str, type[Frozen]] = {
    "order_add": OrderAdd,
    "order_change": OrderChange,
    "order_remove": OrderRemove,
}
"""They stand in the reply's schema alone: the prompt has no token left beside names of places."""
