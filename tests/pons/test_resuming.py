"""``pons resume`` lets a held robot of metal go on, with the key that lies beside it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons import goals
from pons.settings import LaunchSettings
from tests.pons.served_goals import Planner, goal
from tests.pons.standing_bridge import StandingBridge
from wire import Proof
from wire.operator_hmac import authentic

KEY = b"a key of thirty-two bytes, or so"
PATH = "/v1/goals/g1/resume"
Held = tuple[Planner, LaunchSettings, StandingBridge]


@pytest.fixture
def held(served: tuple[Planner, LaunchSettings], tmp_path: Path) -> Iterator[Held]:
    """Give a planner before a held robot of metal, its bridge, and no key yet."""
    planner, settings = served
    planner.held_metal, planner.done = True, "queued"
    planner.goals = [goal("g1", "paused")]
    robot = tmp_path / "robot.toml"
    robot.write_text('id = "r7"\n')
    with (
        TemporaryDirectory(prefix="pr-") as home,
        StandingBridge(Path(home), "r7", virtual=False) as bridge,
    ):
        yield planner, replace(settings, home=Path(home), robot=robot), bridge


def keep_key(settings: LaunchSettings) -> None:
    path = settings.home / "operator.key"
    path.write_bytes(KEY)
    path.chmod(0o600)


def test_a_paused_goal_goes_on_with_a_proof_of_the_key(held: Held) -> None:
    planner, settings, bridge = held
    keep_key(settings)
    assert goals.act(settings, "resume", None) == 0
    (bare, proven) = planner.heard
    assert bare == (PATH, {})
    assert proven[0] == PATH
    sent = proven[1]["operator"]
    assert set(sent) == {"id", "proof"}
    proof = Proof.model_validate(sent["proof"])
    assert proof.nonce == bridge.nonce
    assert authentic(KEY, "resume", "r7", proof, sent["id"])
    assert not authentic(KEY, "arm", "r7", proof, sent["id"])


def test_without_a_key_nothing_goes_on_and_the_command_that_makes_one_is_named(
    held: Held, capsys: pytest.CaptureFixture[str]
) -> None:
    planner, settings, _ = held
    assert goals.act(settings, "resume", None) == goals.EXIT_UNREACHED
    told = capsys.readouterr().err
    assert told.startswith("operator_key_missing")
    assert "pons key new" in told
    assert planner.heard == [(PATH, {})]
    assert planner.goals[0]["state"] == "paused"


def test_where_no_goal_is_paused_the_hold_is_cleared_at_the_bridge(held: Held) -> None:
    planner, settings, bridge = held
    planner.goals = []
    keep_key(settings)
    assert goals.act(settings, "resume", None) == 0
    assert bridge.asked == ["op/resume"]


@pytest.mark.parametrize("verb", ["pause", "cancel"])
def test_no_other_order_is_given_a_proof(held: Held, verb: str) -> None:
    planner, settings, _ = held
    keep_key(settings)
    assert goals.act(settings, verb, "g1") == goals.EXIT["refused"]
    assert planner.heard == [(f"/v1/goals/g1/{verb}", {})]


def test_a_goal_that_a_latched_robot_keeps_paused_is_told_with_the_way_on(
    held: Held, capsys: pytest.CaptureFixture[str]
) -> None:
    planner, settings, _ = held
    keep_key(settings)
    planner.done = "paused"
    assert goals.act(settings, "resume", "g1") == goals.EXIT["refused"]
    assert "pons why" in capsys.readouterr().err
