"""Velocities are numbered as the bridge counts them."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from wire import VelocitySequence
from wire.commands import mark_relayed


@given(st.lists(st.sampled_from(["a", "b", "c"]), max_size=30))
def test_velocities_count_from_one_in_each_epoch_and_never_stand(epochs: list[str]) -> None:
    numbers = VelocitySequence()
    before: tuple[str, int] | None = None
    for epoch in epochs:
        number = numbers.take_next(epoch)
        goes_on = before is not None and before[0] == epoch
        assert number == (before[1] + 1 if goes_on and before is not None else 1)
        before = (epoch, number)


def test_what_the_planner_passes_on_is_called_so_and_stays_a_source() -> None:
    assert mark_relayed("page") == "planner:page"
    assert len(mark_relayed("x" * 64)) == 64
