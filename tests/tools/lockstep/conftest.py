"""Share what every drive begins with: worlds that are armed, owned and standing, made once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tools.lockstep import LockstepWorld
from tools.lockstep.world_fork import fork_world

Ready = Callable[..., LockstepWorld]


@pytest.fixture(scope="session")
def ready() -> Ready:
    """Return a maker of worlds: each a copy of one that was made ready with these parts."""
    made: dict[str, LockstepWorld] = {}

    def copy(**parts: Any) -> LockstepWorld:
        name = repr(sorted(parts.items()))
        if name not in made:
            made[name] = LockstepWorld(**parts)
        return fork_world(made[name])

    return copy
