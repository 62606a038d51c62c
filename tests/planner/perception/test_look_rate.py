"""When the eyes look: at the full rate for who needs them, seldom else, and not while they rest."""

from __future__ import annotations

import pytest

from planner.perception.frame_source import EARLY_S, IDLE_POLL_S, POLL_S, REST_S, SHOWN_S, Attention


@pytest.mark.parametrize(
    ("wanted", "moving", "after_s"), [(True, False, 0.2), (False, True, 0.5), (False, False, 2.0)]
)
def test_a_look_is_due_by_who_wants_it_and_by_the_robots_motion(
    wanted: bool, moving: bool, after_s: float
) -> None:
    attention = Attention(5.0, 30.0)
    attention.attend("goal", wanted)
    assert attention.due(10.0, moving=moving), "none has begun yet"
    attention.began(10.0)
    assert not attention.due(10.0 + after_s - EARLY_S - 0.01, moving=moving)
    assert attention.due(10.0 + after_s - EARLY_S + 0.001, moving=moving)
    attention.rest(20.0)
    assert not attention.due(20.0 + REST_S - 0.01, moving=moving)
    assert attention.due(20.0 + REST_S, moving=moving)


def test_pictures_are_wanted_while_somebody_needs_waits_or_looks_on() -> None:
    attention = Attention(5.0, 10.0)
    assert attention.listens(10.0, glance=True)
    assert not attention.listens(10.0, glance=False)
    with attention.waiting():
        assert attention.listens(10.0, glance=False)
    assert not attention.listens(10.0, glance=False), "who waited is gone"
    for who in ("goal", "page"):
        attention.attend(who, True)
    attention.attend("goal", False)
    assert attention.listens(10.0, glance=False)
    attention.attend("page", False)
    assert attention.poll_s(10.0) == IDLE_POLL_S
    attention.note_shown(10.0)
    assert attention.listens(10.0 + SHOWN_S, glance=False)
    assert attention.poll_s(10.0) == POLL_S
    assert not attention.listens(10.0 + SHOWN_S + 0.01, glance=False)
