"""A trial's conversation with a robot that drives in lockstep: heard, driven, and told."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from tests.conftest import ROOT
from tools.evals import scripts
from tools.evals.conversation import Conversation, converse
from tools.evals.robot import conversation_robot
from tools.evals.scripted_model import ScriptedModel
from tools.evals.scripts import read_scripts
from tools.lockstep import LockstepWorld

pytestmark = pytest.mark.timeout(240)
TALK = (
    "[1] remember that the key is in the desk | answer",
    "[2] where did I say the key is? | answer | new: recall key",
    "  told: answered/recalled; in the desk",
    "[3] is anybody here? | new: look",
    "  model: look is anybody here",
    "  sees: no An empty room.",
    "  told: seen; An empty room.",
    "wait, go to the bedroom | new: go bedroom",
    "[4] stop | stop",
    "[5] where are you? | answer",
    "  told: answered; on the moon",
)


def test_goals_are_driven_seen_by_notes_and_judged_by_what_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "en.txt").write_text("\n## held a talk\n" + "\n".join(TALK) + "\n", "utf-8")
    monkeypatch.setattr(scripts, "SCRIPTS", tmp_path)
    model = ScriptedModel(whims=False)

    async def hold() -> Conversation:
        with conversation_robot(model, ROOT / "sites" / "home", driven=True) as robot:
            held = await converse(read_scripts("en")[0], model, robot)
            assert isinstance(robot.world, LockstepWorld)
            assert robot.world.contacts == 0
            return held

    held = asyncio.run(hold())
    faults = {goal.number: goal.fault for goal in held.goals if goal.fault}
    assert faults.keys() == {"5"}, faults
    assert faults["5"].startswith("ends answered: I am ")
    assert not held.moves_wrongly
