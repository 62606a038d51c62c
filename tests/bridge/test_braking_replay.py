"""A run that begins with what others learnt, and learns more, is repeated from its recording."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core import initial
from bridge.core.state_motion import Learnt
from bridge.replay import replay
from tests.bridge.core.motion.test_braking_learning import ROBOT, Metal, stop
from tests.bridge.core.scripted import World, config
from tests.bridge.recorded import Taken, stream_of, written

if TYPE_CHECKING:
    from pathlib import Path


def test_what_was_known_at_the_start_is_in_the_recording(tmp_path: Path) -> None:
    known = Learnt(lag_more_s=0.03, lag_at_mps=0.4, stops=9)
    core = replace(config(ROBOT), learnt=known, braking_trouble="braking_file_unreadable")
    world = World(core, keep=True, drive=Metal(most_radps2=5.0)).driving()
    stop(world)
    assert world.state.learnt.decel_share < 0.7
    assert world.state.learnt.stops > known.stops
    before, ticks = initial(core, 100.0), list[Taken]()
    for (inbox, now_s), decision in zip(world.inboxes, world.decisions, strict=True):
        ticks.append((before, inbox, now_s, decision))
        before = decision.state
    report = replay(written(tmp_path, stream_of(core, ticks)))
    assert report.first_difference is None
    assert (report.ticks, report.differing) == (len(ticks), 0)
