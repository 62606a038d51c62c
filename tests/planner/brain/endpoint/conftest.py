"""Let the tests of an endpoint wait less between two tries than people's robots do."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from planner.brain.endpoint import response


@pytest.fixture(autouse=True)
def short_pauses() -> Iterator[None]:
    """Shorten the pause before a second try."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(response, "PAUSE_S", 0.01)
        yield
