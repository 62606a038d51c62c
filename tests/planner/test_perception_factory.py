"""Check what the planner sees with: who opens the detector, and who is asked about pictures."""

from __future__ import annotations

import asyncio
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest

from planner.brain.usage_meter import thinking_about
from planner.brain_factory import brain_of, model_of
from planner.budget import purse_of
from planner.perception import Detection, VisionFailure, VisionWorker
from planner.perception_factory import (
    REFUSED_WITHIN_S,
    Opening,
    _by_detector,
    looker_of,
    picture_limits,
    spent_by,
)
from planner.settings import VisionSettings, load_settings
from planner.skills.perception import PictureCost
from planner.skills.search_bounds import MOST_PICTURES
from wire import RobotDescription

ROBOT = RobotDescription()
BLIND = ROBOT.model_copy(update={"camera": ROBOT.camera.model_copy(update={"kind": "none"})})


async def test_without_a_camera_no_process_is_started() -> None:
    opening = Opening(VisionSettings(), BLIND)
    await opening.open()
    assert opening.worker.pid is None
    assert opening.refused is None


@pytest.mark.parametrize(
    ("model", "code", "after_s", "ends"),
    [
        (Path("own.onnx"), "model_broken", 1.0, True),
        (Path("own.onnx"), "model_broken", REFUSED_WITHIN_S + 1.0, False),  # the robot may drive
        (Path("own.onnx"), "detector_down", 1.0, False),  # nobody's word about the model
        (None, "model_broken", 1.0, False),  # nobody set it: nobody can set it right
    ],
)
async def test_only_a_word_about_the_owners_model_at_the_start_ends_the_planner(
    model: Path | None, code: str, after_s: float, ends: bool
) -> None:
    now_s = [5.0]

    async def start() -> None:
        now_s[0] += after_s
        raise VisionFailure(code)

    opening = Opening(VisionSettings(model=model), ROBOT, clock=lambda: now_s[0])
    opening.worker = cast("VisionWorker", SimpleNamespace(start=start))
    await opening.open()
    assert (opening.refused is not None) == ends


def test_the_owners_model_is_asked_about_pictures_and_none_without_one(tmp_path: Path) -> None:
    text = '[model]\nurl = "http://127.0.0.1:1/v1"\nname = "m"\n'
    (tmp_path / "settings.toml").write_text(text, "utf-8")
    settings = load_settings(tmp_path, {})
    purse = purse_of(settings, tmp_path)
    model, worker = model_of(settings, tmp_path, purse), VisionWorker(settings.vision)
    assert model is not None
    brain = brain_of(model, settings)
    looker = looker_of(model, brain, worker)
    assert looker is not None
    assert looker.tag.name == "m"
    assert looker_of(None, brain_of(None, settings), worker) is None
    asyncio.run(model.close())
    purse.close()


def test_a_search_is_bounded_by_the_owner_and_priced(tmp_path: Path) -> None:
    for text, most, money in (
        ("", MOST_PICTURES, None),
        ("[vision]\nsearch_pictures = 7\n", 7, None),
        ("[vision]\nsearch_pictures = 0\n", 0, None),
        ("[budget.goal]\ncalls = 5\n", 4, None),
        ("[budget.goal]\nprompt_tokens = 6300\n", 3, None),
        (
            "[budget.price]\nprompt_per_million = 0.4\nreply_per_million = 1.6\n",
            MOST_PICTURES,
            0.000936,
        ),
    ):
        (tmp_path / "settings.toml").write_text(text, "utf-8")
        limits = picture_limits(load_settings(tmp_path, {}))
        assert limits.most == most, text
        assert limits.by_site is ("search_pictures" not in text)
        assert (limits.currency is None) is (money is None)
        if money is not None:
            assert limits.each.money == pytest.approx(money)


def test_what_a_goal_has_spent_is_asked_of_the_purse(tmp_path: Path) -> None:
    purse = purse_of(load_settings(tmp_path, {}), tmp_path)
    spent = spent_by(purse)

    async def call() -> None:
        with thinking_about("g1"):
            bill = await purse.open(2000)
            bill.close(1500, 40)

    assert spent("g1") == PictureCost()
    asyncio.run(call())
    assert spent("g1").tokens == 1540
    assert spent("g2") == PictureCost()
    purse.close()


def test_the_detector_tells_what_it_saw() -> None:
    seen = [Detection("cup", 0.9, (0.0, 0.0, 1.0, 1.0), "red"),
            Detection("chair", 0.9, (0.0, 0.0, 1.0, 1.0))]  # fmt: skip
    text, answer = _by_detector("what is there?", seen)
    assert (text.en, text.zh) == ("I see: red cup, chair.", "我看到：红色的杯子、椅子。")
    assert answer is None
    assert _by_detector("", ())[0].en == "I see: nothing that I know."
