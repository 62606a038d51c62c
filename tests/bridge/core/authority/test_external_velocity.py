"""Hold another brain to its hand, its rights and its age, by single calls."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.authority import external_velocity
from bridge.core.state_orders import External
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table
from wire import STILL, Owner, Twist2, Velocity


def test_another_brain_is_followed_as_its_hand_says() -> None:
    for held, asked in ((True, Twist2(0.2, 0.1)), (False, STILL)):
        tick = tick_of(reached("active_external"))
        tick.s.bad_bucket = 3.0
        last = tick.s.ownership.external_seq
        assert last is not None
        said = Velocity(source_id="x1", epoch=tick.epoch, seq=last + 1, dead_man=held,
                        seen=tick.s.voice.status_seq, v_mps=0.2, w_radps=0.1)  # fmt: skip
        external_velocity.hear_external(tick, said)
        sent_s = tick.s.voice.ring[-1]
        assert tick.s.external == External(asked.v_mps, asked.w_radps, held, sent_s)
        assert (tick.s.ownership.external_seq, tick.s.bad_bucket) == (last + 1, 2.0)
        assert external_velocity.requested_twist(tick) == asked
        for age_s, calls in ((0.25, held), (0.2501, False)):
            tick.s.external = replace(tick.s.external, sent_s=0.0)
            tick.now_s = age_s
            assert external_velocity.asks_to_move(tick) is calls
        tick.s.external = None
        assert external_velocity.requested_twist(tick) == STILL
        assert not external_velocity.asks_to_move(tick)


@table(
    ("change", "code", "score"),
    [("mission", "no_grant", 3.0), ("kind", "no_grant", 3.0), ("back", "seq_backwards", 4.0),
     ("again", "repeated", 3.0)],
)  # fmt: skip
def test_another_brain_is_not_followed_without_its_rights(
    change: str, code: str, score: float
) -> None:
    tick = tick_of(reached("active_external"))
    tick.s.bad_bucket = 3.0
    before, last = tick.s.external, tick.s.ownership.external_seq
    assert last is not None
    if change == "mission":
        tick.s.grants = replace(tick.s.grants, mission=None)
    elif change == "kind":
        owner = Owner(planner_id="x1", kind="planner")
        tick.s.ownership = replace(tick.s.ownership, owner=owner)
    seq = {"back": last - 1, "again": last}.get(change, last + 1)
    said = Velocity(source_id="x1", epoch=tick.epoch, seq=seq, dead_man=True,
                    seen=tick.s.voice.status_seq, v_mps=0.2, w_radps=0.1)  # fmt: skip
    external_velocity.hear_external(tick, said)
    assert (tick.reasons, tick.s.bad_bucket) == ([code], score)
    assert tick.s.external == before
