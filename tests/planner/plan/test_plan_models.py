"""Check the closed vocabulary of plans: what is accepted, what is refused, what survives JSON."""

from __future__ import annotations

import math
import re
from datetime import UTC, datetime
from typing import Any, get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from planner.language.catalogue import message
from planner.language.place_lists import known_places, rejection_outcome
from planner.plan import (
    CALLS,
    DRIVES,
    GIVEN,
    NEEDS_CAMERA,
    PLAN,
    RUNNABLE,
    TOOL_CALLS,
    AnswerPlan,
    Bilingual,
    BrainTag,
    Clarify,
    Code,
    Entry,
    Goal,
    GoalState,
    GoTo,
    Language,
    Option,
    Outcome,
    PlanRejection,
    Spot,
    Step,
    StepPlan,
    Vocabulary,
    Wait,
    check_plan,
    fault,
    plan_record,
)


def entry(id_: str, en: str, zh: str, kind: str = "room", **more: Any) -> Entry:
    return Entry.model_validate({"id": id_, "kind": kind, "name": {"en": en, "zh": zh}, **more})


HOME = Vocabulary(entries=(entry("kitchen", "kitchen", "厨房"), entry("study", "study", "书房")))

STEPS: list[dict[str, Any]] = [
    {"kind": "go_to", "place": "kitchen"},
    {"kind": "go_to_pose", "map_id": "0123456789abcdef", "x_m": 1.5, "y_m": 2.0, "yaw_rad": 1.5},
    {"kind": "come_back"},
    {"kind": "return_home"},
    {"kind": "wait", "seconds": 5.0},
    {"kind": "say", "text": "hello <b>you</b>"},
    {"kind": "ask", "question": "which cup?"},
    {"kind": "decide", "question": "is it there?"},
    {"kind": "turn", "angle_rad": 1.5},
    {"kind": "move", "distance_m": -0.5},
    {"kind": "patrol", "places": ["kitchen", "study"]},
    {"kind": "stand_at", "place": "kitchen", "side": "beside", "distance_m": 0.5},
    {"kind": "go_to_object", "object": "red cup"},
    {"kind": "go_to_point", "x": 500, "y": 1000},
    {"kind": "find", "object": "red cup", "place": "kitchen"},
    {"kind": "count", "object": "people", "place": None},
    {"kind": "look", "question": "what do you see?"},
    {"kind": "follow", "object": "the person"},
    {"kind": "explore"},
    {"kind": "use_skill", "name": "evening_round", "arguments": ["kitchen", ""]},
    {"kind": "use_tool", "tool": "calendar.events", "arguments": ["today", ""]},
    {"kind": "recall", "object": "red cup", "place": "kitchen", "span": "morning"},
    {"kind": "wait_for", "word": "go", "seconds": 60.0},
    {
        "kind": "if",
        "when": {"kind": "ask", "question": "may I come in?"},
        "then": [{"kind": "go_to", "place": "study"}],
        "otherwise": [{"kind": "say", "text": "it is shut"}],
    },
    {
        "kind": "try",
        "steps": [{"kind": "go_to", "place": "kitchen"}],
        "on_failure": [{"kind": "say", "text": "dinner is ready"}],
    },
    {
        "kind": "repeat",
        "times": 3,
        "seconds": 600.0,
        "steps": [{"kind": "go_to", "place": "kitchen"}],
        "until": {"kind": "clock", "after": "18:30"},
    },
]
KINDS = [cls.model_fields["kind"].default for cls in get_args(get_args(Step)[0])]


def test_every_kind_of_step_is_tried_here() -> None:
    assert sorted(KINDS) == sorted(step["kind"] for step in STEPS)
    assert set(KINDS) >= RUNNABLE | NEEDS_CAMERA | DRIVES


@pytest.mark.parametrize("step", STEPS, ids=lambda step: str(step["kind"]))
def test_plan_survives_json(step: dict[str, Any]) -> None:
    plan = PLAN.validate_python({"kind": "plan", "steps": [step]})
    assert PLAN.validate_json(PLAN.dump_json(plan)) == plan
    assert plan_record(plan).steps[0].kind == step["kind"]


@pytest.mark.parametrize(
    "bad",
    [
        {"kind": "wait", "seconds": math.nan},
        {"kind": "wait", "seconds": math.inf},
        {"kind": "wait", "seconds": 0},
        {"kind": "wait", "seconds": 601},
        {"kind": "turn", "angle_rad": 100},
        {"kind": "move", "distance_m": -math.inf},
        {"kind": "go_to", "place": "Kitchen; DROP TABLE"},
        {"kind": "go_to", "place": ""},
        {"kind": "go_to", "place": "kitchen", "x": 2.0},
        {"kind": "go_to", "place": "kitchen", "speed": 9},
        {"kind": "go_to_point", "x": 1001, "y": 0},
        {"kind": "say", "text": "  "},
        {"kind": "patrol", "places": []},
        {"kind": "fly"},
        {"kind": "repeat", "times": 10**9, "steps": [{"kind": "come_back"}]},
        {"kind": "repeat", "times": 0, "steps": [{"kind": "come_back"}]},
        {"kind": "repeat", "seconds": math.inf, "steps": [{"kind": "come_back"}]},
        {"kind": "repeat", "steps": []},
        {"kind": "repeat", "steps": [{"kind": "come_back"}], "until": "never"},
        {
            "kind": "if",
            "when": {"kind": "go_to", "place": "kitchen"},
            "then": [{"kind": "explore"}],
        },
        {"kind": "if", "when": {"kind": "clock"}, "then": [{"kind": "explore"}]},
        {"kind": "if", "when": {"kind": "clock", "after": "25:00"}, "then": [{"kind": "explore"}]},
        {"kind": "if", "when": {"kind": "look", "question": "is it?"}, "then": []},
        {"kind": "try", "steps": [{"kind": "explore"}]},
        {"kind": "wait_for"},
        {"kind": "wait_for", "object": "person", "word": "go"},
        {"kind": "wait_for", "object": "person", "seconds": 601},
        {"kind": "wait_for", "time": "8 pm"},
        {},
    ],
    ids=str,
)
def test_bad_step_is_refused(bad: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        PLAN.validate_python({"kind": "plan", "steps": [bad]})


def test_a_plan_cannot_also_refuse() -> None:
    reason = {"en": "no", "zh": "不"}
    mixed = {"kind": "refuse", "code": "unsafe", "reason": reason, "steps": [STEPS[0]]}
    with pytest.raises(ValidationError, match="steps"):
        PLAN.validate_python(mixed)


def rejected(steps: tuple[Any, ...]) -> PlanRejection:
    verdict = check_plan(StepPlan(steps=steps), HOME)
    assert verdict is not None
    return verdict


def test_a_plan_of_known_places_passes_up_to_twenty_steps() -> None:
    steps = (GoTo(place="kitchen"), Wait(seconds=1.0)) * 10
    assert check_plan(StepPlan(steps=steps), HOME) is None


def test_unknown_place_is_refused_and_names_what_exists() -> None:
    verdict = rejected((GoTo(place="kitchen"), GoTo(place="garage")))
    assert [(r.code, r.step) for r in verdict.reasons] == [(Code.UNKNOWN_PLACE, 1)]
    assert verdict.repairable
    assert "garage" in rejection_outcome(verdict, HOME).message.en
    assert "书房" in rejection_outcome(verdict, HOME).message.zh


@pytest.mark.parametrize("count", [0, 21, 500])
def test_empty_and_long_plans_are_refused(count: int) -> None:
    verdict = rejected((GoTo(place="kitchen"),) * count)
    assert rejection_outcome(verdict, HOME).code is Code.BAD_PLAN
    assert str(count) in rejection_outcome(verdict, HOME).message.en
    assert not re.search("[a-z]{2}", rejection_outcome(verdict, HOME).message.zh)


@pytest.mark.parametrize("step", STEPS, ids=lambda step: str(step["kind"]))
def test_what_cannot_run_is_refused_with_its_code(step: dict[str, Any]) -> None:
    plan = PLAN.validate_python({"kind": "plan", "steps": [STEPS[0], step]})
    verdict = check_plan(plan, HOME)
    if step["kind"] in RUNNABLE:
        assert verdict is None
        return
    assert verdict is not None
    kinds = (
        (NEEDS_CAMERA, Code.NO_CAMERA), (GIVEN, Code.POINT_NOT_GIVEN),
        (CALLS | TOOL_CALLS, Code.NO_CAPABILITY),
    )  # fmt: skip
    lack = next((code for kinds_of, code in kinds if step["kind"] in kinds_of), Code.NOT_MAPPING)
    assert rejection_outcome(verdict, HOME).code is lack
    chinese = rejection_outcome(verdict, HOME).message.zh.replace("`pons up --map", "")
    assert not re.search("[a-z]{2}", chinese), chinese
    assert not verdict.repairable


def test_all_reasons_are_collected_and_the_hopeless_one_is_told() -> None:
    plan = PLAN.validate_python(
        {"kind": "plan", "steps": [{"kind": "go_to", "place": "moon"}, STEPS[12]]}
    )
    verdict = check_plan(plan, HOME)
    assert verdict is not None
    assert [r.code for r in verdict.reasons] == [Code.UNKNOWN_PLACE, Code.NO_CAMERA]
    assert rejection_outcome(verdict, HOME).code is Code.NO_CAMERA


def test_answers_and_questions_pass_untouched() -> None:
    answer = AnswerPlan(text=Bilingual(en="here", zh="这里"))
    question = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="?", zh="？"))
    assert check_plan(answer, HOME) is None
    assert check_plan(question, HOME) is None


def test_ids_must_be_unique() -> None:
    with pytest.raises(ValidationError, match="given twice: kitchen"):
        Vocabulary(entries=(entry("kitchen", "a", "b"), entry("kitchen", "c", "d")))


def test_a_long_list_of_places_is_cut_in_messages() -> None:
    many = Vocabulary(entries=tuple(entry(f"p{i}", f"p{i}", f"地{i}") for i in range(50)))
    assert known_places(many).en.endswith("p29, and 20 more")
    assert known_places(many).zh.endswith("还有 20 处")


def test_goal_record_round_trips() -> None:
    now = datetime(2030, 1, 2, tzinfo=UTC)
    plan = StepPlan(steps=(GoTo(place="kitchen"),))
    spot = Spot(place="kitchen", room="kitchen", x_m=1.0, y_m=2.0, yaw_rad=0.0)
    goal = Goal(
        id="g1",
        text="go to the kitchen",
        language=Language.EN,
        state=GoalState.SUCCEEDED,
        plan=plan_record(plan),
        outcome=Outcome(
            code=Code.ARRIVED,
            message=message(Code.ARRIVED, place=HOME.name("kitchen")),
            asked=spot,
            reached=spot,
            metres=3.5,
            seconds=9.0,
            limited_by=("scan",),
        ),
        brain=BrainTag(name="offline", version="1"),
        created=now,
        updated=now,
    )
    assert Goal.model_validate_json(goal.model_dump_json()) == goal
    assert goal.outcome is not None
    assert goal.outcome.message == Bilingual(en="Arrived: kitchen.", zh="我到了：厨房。")


def test_clarify_record_keeps_its_options() -> None:
    option = Option(label=Bilingual(en="kitchen", zh="厨房"), text="go to the kitchen")
    asked = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="?", zh="？"), options=(option,))
    assert plan_record(asked).options == (option,)
    assert plan_record(asked).code is Code.AMBIGUOUS


def test_a_fault_is_a_reason_with_its_row() -> None:
    assert fault("LIDAR_STALE") == "fault(LIDAR_STALE)"


@given(st.floats(allow_nan=True, allow_infinity=True))
@settings(max_examples=60)
def test_wait_accepts_only_its_bounds(seconds: float) -> None:
    step = {"kind": "wait", "seconds": seconds}
    if 0.0 < seconds <= 600.0:
        PLAN.validate_python({"kind": "plan", "steps": [step]})
    else:
        with pytest.raises(ValidationError):
            PLAN.validate_python({"kind": "plan", "steps": [step]})


def nested(deep: int) -> dict[str, Any]:
    step: dict[str, Any] = {"kind": "say", "text": "hello"}
    for _ in range(deep):
        step = {"kind": "repeat", "times": 2, "steps": [step]}
    return step


@pytest.mark.parametrize(
    ("step", "word"),
    [
        (nested(4), "deep"),
        (nested(200), "deep"),
        ({"kind": "repeat", "times": 20, "steps": [nested(1), {"kind": "repeat", "times": 20,
          "steps": [{"kind": "say", "text": "hello"}]}]}, "over all rounds"),
        ({"kind": "repeat", "times": 20,
          "steps": [{"kind": "patrol", "places": ["kitchen", "study"] * 10}]}, "over all rounds"),
        ({"kind": "repeat", "times": 20, "steps": [{"kind": "wait", "seconds": 600}]}, "waits of"),
        ({"kind": "repeat", "times": 2,
          "steps": [{"kind": "decide", "question": "and now?"}]}, "decide inside repeat"),
    ],
)  # fmt: skip
def test_a_tree_beyond_its_bounds_is_refused_with_what_is_expected(
    step: dict[str, Any], word: str
) -> None:
    plan = PLAN.validate_python({"kind": "plan", "steps": [step]})
    rejection = check_plan(plan, HOME)
    assert rejection is not None
    assert rejection.repairable, "a model can write it better"
    assert {reason.code for reason in rejection.reasons} == {Code.BAD_PLAN}
    assert any(word in reason.what for reason in rejection.reasons)
    assert check_plan(plan_record(plan).steps, HOME) == rejection, "the record is judged alike"


def test_every_branch_is_judged() -> None:
    for branch in ("then", "otherwise"):
        step = {
            "kind": "if",
            "when": {"kind": "clock", "after": "18:00"},
            "then": [{"kind": "go_to", "place": "kitchen"}],
        }
        step[branch] = [{"kind": "go_to", "place": "cellar"}]
        rejection = check_plan(PLAN.validate_python({"kind": "plan", "steps": [step]}), HOME)
        assert rejection is not None
        assert rejection.first.code is Code.UNKNOWN_PLACE


def test_who_has_no_detector_waits_for_nobody() -> None:
    waits = PLAN.validate_python({"kind": "plan", "steps": [
        {"kind": "wait_for", "object": "person"}]})  # fmt: skip
    rejection = check_plan(waits, HOME)
    assert rejection is not None
    assert rejection.first.code is Code.NO_CAMERA
