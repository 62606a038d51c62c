"""A trial's conversation with a robot that drives in lockstep: heard, driven, and told."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from pons.evals import person_scripts
from pons.evals.driven_person import driven_robot
from pons.evals.person import Conversation, converse
from pons.evals.person_robot import ScriptedModel
from pons.evals.person_scripts import read_scripts
from tests.conftest import ROOT

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
    monkeypatch.setattr(person_scripts, "SCRIPTS", tmp_path)
    model = ScriptedModel(whims=False)

    async def hold() -> Conversation:
        with driven_robot(model, ROOT / "sites" / "home") as robot:
            held = await converse(read_scripts("en")[0], model, robot)
            assert robot.world.contacts == 0
            return held

    held = asyncio.run(hold())
    faults = {goal.number: goal.fault for goal in held.goals if goal.fault}
    assert faults.keys() == {"5"}, faults
    assert faults["5"].startswith("ends answered: I am ")
    assert not held.moves_wrongly
