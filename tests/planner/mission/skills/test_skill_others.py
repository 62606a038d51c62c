"""Places, waits and words: what each skill asks for, at its beginning, on the way and again."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.mission.skills import (
    SKILLS,
    STATES,
    DriveLeg,
    Fail,
    Finish,
    Question,
    SkillAction,
    Skip,
    Speak,
    Stand,
    Think,
    act_of,
    begin_state,
)
from planner.plan import (
    CONDITIONS,
    CONTROL,
    EVERY_KIND,
    GIVEN,
    NEEDS_CAMERA,
    NEEDS_GROWING_MAP,
    RUNNABLE,
    TOOL_CALLS,
    Code,
    Means,
    StepState,
    say_same,
)
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.skills.scenes import scene
from wire import Pose2

HALL, DOCK = FACTS.targets["hall"].pose, FACTS.targets["dock"].pose
BACK = Pose2(1.0, 1.0, 0.5)


def test_what_may_be_planned_has_a_skill_and_what_it_takes_is_known() -> None:
    whole = Means(camera=True, detector=True, growing_map=True)
    assert set(SKILLS) | CONTROL == EVERY_KIND | GIVEN | CONDITIONS | TOOL_CALLS
    assert whole.runnable == EVERY_KIND | GIVEN | TOOL_CALLS
    assert (
        Means().runnable - GIVEN - TOOL_CALLS
        == RUNNABLE
        == EVERY_KIND - NEEDS_CAMERA - NEEDS_GROWING_MAP
    )
    assert Means(growing_map=True).plannable - RUNNABLE == NEEDS_GROWING_MAP == {"explore"}
    blind = Means(camera=True)
    assert blind.runnable - RUNNABLE - TOOL_CALLS == {"go_to_point", "go_to_pose"}
    assert Means(camera=True, model=True).runnable - blind.runnable == {"look"}
    assert blind.plannable == RUNNABLE, "who sees no picture can't point at it"
    assert Means(camera=True, detector=True).lacks("explore") is Code.NOT_MAPPING
    assert [m.lacks("find") for m in (Means(), blind)] == [Code.NO_CAMERA, Code.NO_DETECTOR]


@pytest.mark.parametrize(
    ("kind", "step", "more", "act"),
    [
        ("go_to", {"place": "hall"}, {}, DriveLeg(HALL, heading=False, target="hall")),
        ("go_to", {"place": "dock"}, {}, DriveLeg(DOCK, heading=True, target="dock")),
        ("go_to", {"place": "hall"}, {"part": 1}, Finish()),
        ("return_home", {}, {}, DriveLeg(DOCK, heading=True, target="dock")),
        ("return_home", {}, {"part": 1}, Finish()),
        ("come_back", {}, {"accepted": BACK}, DriveLeg(BACK, heading=True)),
        ("come_back", {}, {"accepted": BACK, "part": 1}, Finish()),
        ("come_back", {}, {"accepted": None}, Fail(Code.NO_ROUTE, "no_route")),
        ("patrol", {"places": ("hall", "dock")}, {}, DriveLeg(HALL, heading=False, target="hall")),
        ("patrol", {"places": ("hall", "dock")}, {"part": 1}, DriveLeg(DOCK, True, target="dock")),
        ("patrol", {"places": ("hall", "dock")}, {"part": 2}, Finish({"visited": 2})),
        ("wait", {"seconds": 3.0}, {}, Stand(3.0)),
        ("say", {"text": "hi"}, {}, Speak("hi")),
        ("say", {"text": "hi", "state": StepState.RUNNING}, {}, Skip("perhaps_said")),
        ("ask", {"text": "who?"}, {}, Question(say_same("who?"))),
        ("ask", {"text": "who?", "answer": "me"}, {}, Finish()),
        ("decide", {"text": "where?"}, {}, Think()),
    ],
)
def test_each_skill_asks_for_one_thing(
    kind: str, step: dict[str, Any], more: dict[str, Any], act: SkillAction
) -> None:
    assert act_of(scene(kind, step=step, **more)) == act


@pytest.mark.parametrize(
    ("kind", "step"),
    [("go_to", {"place": "attic"}), ("patrol", {"places": ("hall", "attic")}), ("return_home", {})],
)
def test_a_place_that_is_gone_is_not_driven_to(kind: str, step: dict[str, Any]) -> None:
    facts = replace(FACTS, home="attic")
    act = act_of(scene(kind, step=step, facts=facts, part=1 if kind == "patrol" else 0))
    assert isinstance(act, Fail)
    assert (act.code, act.reason) == (Code.UNKNOWN_PLACE, "place_gone")
    assert act.said is not None
    assert "attic" in act.said.en
    assert "hall" in act.said.zh


@pytest.mark.parametrize("kind", sorted(NEEDS_CAMERA))
def test_what_needs_a_camera_says_so(kind: str) -> None:
    act = act_of(scene(kind))
    assert isinstance(act, Fail)
    assert act.code is Code.NO_CAMERA


@pytest.mark.parametrize("kind", sorted(STATES))
def test_a_skill_remembers_nothing_that_is_anothers(kind: str) -> None:
    mine = STATES[kind]()
    for foreign in {name for state in STATES.values() for name in state.model_fields}:
        if foreign not in STATES[kind].model_fields:
            with pytest.raises(
                TypeError, match=f"{STATES[kind].__name__} has no {foreign}; it has"
            ):
                mine.but(**{foreign: None})


@pytest.mark.parametrize("kind", sorted(SKILLS))
def test_a_skill_is_asked_with_its_own_state_alone(kind: str) -> None:
    own = begin_state(kind)
    for other in (None, *(state() for state in STATES.values())):
        if type(other) is not type(own):
            with pytest.raises(TypeError, match=f"the step '{kind}' needs the state"):
                act_of(scene(kind, state=other))
