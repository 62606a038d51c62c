"""Own the base of what a skill remembers of its step. Data only."""

from __future__ import annotations

from typing import Any, Self

from planner.plan import Frozen


class SkillStateBase(Frozen):
    """Be the base of what a skill remembers."""

    def but(self, **changes: Any) -> Self:
        """Return this state with changes.

        Raises:
            TypeError: this skill remembers no such thing.
        """
        foreign = changes.keys() - type(self).model_fields.keys()
        if foreign:
            name = type(self).__name__
            known = ", ".join(sorted(type(self).model_fields))
            raise TypeError(f"{name} has no {', '.join(sorted(foreign))}; it has {known}")
        return self.model_copy(update=changes)
