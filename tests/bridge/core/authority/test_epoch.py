"""Hold what a new epoch voids."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.authority.epoch import new_epoch
from bridge.core.state_orders import Stick
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table


@table(("start", "keep_stick"), [("active", False), ("active_external", True), ("teleop", True)])
def test_nothing_meant_for_the_old_epoch_outlives_it(start: str, keep_stick: bool) -> None:
    tick = tick_of(reached(start))
    s = tick.s
    s.ownership = replace(s.ownership, waypoints_seq=7, external_seq=8)
    s.leg = replace(reached("active").state.leg, refusal="fence")
    s.external = reached("active_external").state.external
    s.stick = stick = replace(reached("teleop").state.stick, seq=5)
    leg, epoch_no, owner = s.leg, s.epoch_no, s.ownership
    assert None not in (s.external, leg.horizon, leg.path)
    new_epoch(tick, "test", keep_stick=keep_stick)
    assert s.epoch_no == epoch_no + 1
    assert s.ownership == replace(owner, waypoints_seq=None, external_seq=None)
    assert s.leg == replace(leg, horizon=None, path=None, refusal=None)
    assert s.external is None
    assert s.stick == (replace(stick, seq=-1) if keep_stick else Stick())
    assert s.grants.mission is None
    assert tick.events == [("epoch", "test")]
