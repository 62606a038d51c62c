"""A page begins a trial by proof alone; its silence and any stop end it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from devices.camera_listing import CameraEntry
from pons.robot.command import HEAD
from pons.robot.page_person import PagePerson
from pons.robot.trial_desk import TrialDesk
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_run import plan_steps
from pons.robot.trial_words import STEPS
from tests.conftest import ROOT
from tests.known import known
from tests.pons.robot.stand import Stand, alive
from wire import CameraConfig, Proof, TrialOrder, TrialState, load_robot, sign
from wire.imu_config import ImuConfig
from wire.keys import TRIAL_STATE
from wire.trial_dialogue import UNWATCHED_S, mark_of

KEY = b"k" * 32
TEXT = (ROOT / "robots" / "pons_mcu_ld19.toml").read_text("utf-8")


class Clock:
    """Give the time that a test sets."""

    now_s = 10.0

    def __call__(self) -> float:
        return self.now_s


def test_a_question_is_answered_by_its_own_number_alone() -> None:
    person = PagePerson(Clock())
    person.ask("hand_left")
    for wrong in (0, 2):
        person.watch(wrong)
        assert not person.has_answered()
    person.watch(1)
    assert person.has_answered()
    assert person.code is None
    person.ask("hand_right")
    assert not person.has_answered()


def test_a_page_that_falls_silent_is_gone_and_one_that_speaks_is_not() -> None:
    clock = Clock()
    person = PagePerson(clock)
    for _ in range(20):
        clock.now_s += UNWATCHED_S * 0.99
        person.require_watch()
        person.watch(0)
    clock.now_s += UNWATCHED_S * 1.01
    with pytest.raises(TrialRefusal, match="trial_unwatched"):
        person.require_watch()
    clock.now_s = float("nan")
    with pytest.raises(TrialRefusal, match="trial_unwatched"):
        person.require_watch()


def test_a_stop_is_taken_back_by_nothing() -> None:
    person = PagePerson(Clock())
    person.stop()
    person.watch(0)
    with pytest.raises(TrialRefusal, match="trial_stopped"):
        person.require_watch()


def test_what_a_step_saw_stands_beside_it() -> None:
    person = PagePerson(Clock())
    person.tell("listen")
    person.tell("hand_left", "100 Hz")
    assert [(one.step, one.seen) for one in person.steps] == [
        ("listen", "100 Hz"),
        ("hand_left", ""),
    ]


def test_every_step_has_its_words() -> None:
    bare = load_robot(ROOT / "robots" / "pons_mcu_ld19.toml")
    with_gyro = load_robot(ROOT / "robots" / "waveshare_ugv_rover.toml")
    uvc = CameraConfig(kind="uvc", device="/dev/video0")
    with_camera = bare.model_copy(update={"camera": uvc})
    planned = {*plan_steps(bare), *plan_steps(with_gyro), *plan_steps(with_camera)}
    assert planned == set(STEPS)
    assert "camera_cover" in plan_steps(with_camera)
    assert "camera_cover" not in plan_steps(bare)
    assert "gyro_left" in plan_steps(with_gyro)
    assert "gyro_left" not in plan_steps(bare)
    chip = ImuConfig(kind="mpu6050", bus=1, address=0x68)
    counts = bare.inputs.model_copy(update={"imu": True})
    on_i2c = bare.model_copy(update={"imu": chip, "inputs": counts})
    assert "gyro_left" in plan_steps(on_i2c)


@contextmanager
def desk_at(folder: Path, clock: Clock | None = None) -> Iterator[TrialDesk]:
    path = folder / "robot.toml"
    path.write_text(TEXT.replace("/dev/tty", f"{folder}/no"))
    made = TrialDesk(path, KEY, "boot1", clock or time.monotonic)
    try:
        yield made
    finally:
        made.close()


def begin(desk: TrialDesk, request: str, key: bytes = KEY, nonce: str | None = None) -> TrialState:
    proof = sign(key, "trial", "r1", nonce or desk.nonce, request)
    desk.take(TrialOrder(id=request, source="t", act="begin", proof=proof))
    return rested(desk)


def rested(desk: TrialDesk) -> TrialState:
    for _ in range(500):
        if not desk.is_busy:
            break
        threading.Event().wait(0.01)
    return desk.state()


def test_without_a_fitting_proof_nothing_is_opened_and_a_nonce_counts_once(tmp_path: Path) -> None:
    with desk_at(tmp_path) as desk:
        first = desk.nonce
        assert begin(desk, "a", key=b"x" * 32).code == "trial_untold"
        assert desk.nonce == first, "a bad begin keeps nobody out"
        assert begin(desk, "b", nonce=first).code == "trial_port", "the owner's own is taken"
        assert desk.nonce != first
        assert begin(desk, "e", nonce=first).code == "trial_untold", "and counts once"
        desk.take(TrialOrder(id="c", source="t", act="begin"))
        assert desk.state().code == "trial_untold"
        forged = Proof(nonce=desk.nonce, mac="0" * 64)
        desk.take(TrialOrder(id="d", source="t", act="begin", proof=forged))
        assert desk.state().code == "trial_untold"
        assert not desk.may_turn


def test_what_a_page_shows_of_a_trial_does_not_let_another_watch_it(tmp_path: Path) -> None:
    with desk_at(tmp_path) as desk:
        shown = begin(desk, "page-5f1c").model_dump_json()
        assert "page-5f1c" not in shown
        assert mark_of("page-5f1c") in shown
    assert mark_of("page-0011") == "10907a7983adcea612788bdde4905ac4", "as web/test/proof.test.ts"


def test_a_port_that_is_not_there_is_named_with_its_cure(tmp_path: Path) -> None:
    with desk_at(tmp_path) as desk:
        state = begin(desk, "a")
        assert (state.phase, state.code, state.by) == ("refused", "trial_port", mark_of("a"))
        assert state.detail.startswith("port_missing")
        assert state.cure is not None
        assert TRIAL_STATE.max_bytes > len(state.model_dump_json())


def test_half_a_robot_toml_is_named_and_what_was_mended_is_read_anew(tmp_path: Path) -> None:
    with desk_at(tmp_path) as desk:
        path = tmp_path / "robot.toml"
        whole = path.read_text("utf-8")
        path.write_text(whole[: whole.index("ticks_per_turn")])
        state = begin(desk, "a")
        assert state.code == "trial_config"
        assert "ticks_per_turn" in state.detail
        path.write_text(whole)
        assert begin(desk, "b").code == "trial_port"


def test_a_page_is_shown_cameras_beside_the_ports(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lasting = Path("/dev/v4l/by-id/usb-x")
    entries = [
        CameraEntry(Path("/dev/video0"), lasting, "Webcam\x1b[2J", is_permitted=True),
        CameraEntry(Path("/dev/video2"), Path("/dev/video2"), "Other", is_permitted=False),
    ]
    monkeypatch.setattr("pons.robot.trial_desk.list_ports", list)
    monkeypatch.setattr("pons.robot.trial_desk.list_cameras", lambda: entries)
    with desk_at(tmp_path) as desk:
        desk.take(TrialOrder(id="a", source="t", act="find"))
        state = rested(desk)
    assert state.ports is not None
    assert [one.code for one in state.ports] == ["camera_found", "camera_forbidden"]
    assert (state.ports[0].adapter, state.ports[0].cure) == ("Webcam?[2J", None)
    assert state.ports[1].cure is not None
    assert state.part[:4] == (HEAD, "[camera]", 'kind = "uvc"', f'device = "{lasting}"')


def test_an_untried_robot_does_not_leave(tmp_path: Path) -> None:
    with desk_at(tmp_path) as desk:
        desk.take(TrialOrder(id="a", source="t", act="leave"))
        assert not desk.leaves
        assert desk.state().code == "trial_missing"


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_cable_pulled_in_the_middle_of_a_pages_trial_is_told_and_nothing_is_written(
    tmp_path: Path,
) -> None:
    """At a real line, in real time."""
    with desk_at(tmp_path) as desk:
        path = tmp_path / "robot.toml"
        robot = load_robot(path)
        before = path.read_text("utf-8")
        stand = Stand(robot)
        with alive(stand, Path(known(robot.drive.port))):
            proof = sign(KEY, "trial", "r1", desk.nonce, "a")
            desk.take(TrialOrder(id="a", source="t", act="begin", proof=proof))
            until(desk, lambda state: state.ask == 1, answered=0)
        state = until(desk, lambda state: state.phase == "refused", answered=0)
        assert (state.code, state.detail[:5]) == ("trial_port", "port_")
        assert "plug it in" in known(state.cure).en
        assert path.read_text("utf-8") == before
        assert stand.wheels.fastest_radps == 0.0


def until(desk: TrialDesk, done: Callable[[TrialState], bool], answered: int) -> TrialState:
    """Watch as a page does until something is so."""
    for _ in range(1_500):
        desk.take(TrialOrder(id="a", source="t", act="watch", answered=answered))
        state = desk.state()
        if done(state):
            return state
        threading.Event().wait(0.02)
    raise AssertionError(f"{desk.state()}")
