"""Own what every contender is asked: one order, one closed world, one flat shape of a plan.

pydantic alone: this file runs in the peers' own environment as well.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, create_model


@dataclass(frozen=True, slots=True)
class PeerFacts:
    """Hold what the bench wrote down for its contenders."""

    url: str
    system: str
    order: str
    """The person's message as our prompt writes it."""
    said: str
    site: str
    places: tuple[str, ...]
    kinds: tuple[str, ...]
    steps: int
    """That the endpoint's plan has."""

    @classmethod
    def load(cls, path: str) -> PeerFacts:
        """Read them."""
        content: Any = json.loads(Path(path).read_text("utf-8"))
        content |= {name: tuple(content[name]) for name in ("places", "kinds")}
        return cls(**content)


def plan_model(facts: PeerFacts) -> type[BaseModel]:
    """Return the shape of a plan in this closed world."""
    place: Any = Literal[facts.places]
    kind: Any = Literal[facts.kinds]
    step: Any = create_model(
        "Step",
        kind=(kind, ...),
        place=(place | None, None),
        seconds=(float | None, None),
        text=(str | None, None),
    )
    whole: Any = Literal["plan", "answer", "clarify", "refuse"]
    return create_model("PlanOut", kind=(whole, ...), steps=(list[step], ...))


def check(plan: Any, facts: PeerFacts) -> None:
    """Refuse to time what is no plan. Raises ValueError."""
    if not isinstance(plan, BaseModel) or len(plan.model_dump()["steps"]) != facts.steps:
        raise ValueError(f"no plan came back: {plan!r}")
