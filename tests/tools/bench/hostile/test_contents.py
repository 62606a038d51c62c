"""What a hostile client says is in schema, reaches every key, and holds no operator's proof."""

from __future__ import annotations

from random import Random
from typing import cast

import pytest

from tests.wire.examples import EXAMPLES
from tools.bench.hostile.contents import MOODS, Liar
from tools.bench.hostile.draw import Mood
from wire import VIRTUAL_KEY, OpKind, OpRequest, keys
from wire.codec import decode
from wire.errors import DecodeFailure
from wire.keys import IMAGE, KEYS
from wire.operator_hmac import authentic

BY_PATH = {key.path: key for key in KEYS}


def liar(*, heard: bool = True) -> Liar:
    newest = {key.path: EXAMPLES[key.message] for key in KEYS if key.max_bytes < IMAGE}
    return Liar(Random(7), newest if heard else {})


def test_all_that_is_said_on_purpose_is_in_schema() -> None:
    for mood in set(Mood) - {Mood.GARBAGE}:
        one = liar()
        for _ in range(100):
            for path, payload in one.say((mood,)):
                assert not isinstance(decode(BY_PATH[path], payload), DecodeFailure), (mood, path)


def test_every_key_is_said_but_the_pictures() -> None:
    one = liar()
    said = {path for _ in range(20) for path, _ in one.say(tuple(set(Mood) - {Mood.GARBAGE}))}
    pictures = {key.path for key in KEYS if key.max_bytes == IMAGE}
    of_set_up = {keys.TRIAL_ORDER.path, keys.TRIAL_STATE.path}  # heard while no bridge drives
    assert said == set(BY_PATH) - pictures - {keys.SIM_SCENE.path} - of_set_up
    one = liar()
    assert {path for _ in range(200) for path, _ in one.say((Mood.GARBAGE,))} == set(BY_PATH)


def test_a_client_that_heard_nothing_says_what_it_can() -> None:
    for mood in Mood:
        assert isinstance(liar(heard=False).say((mood,)), list)


def test_the_same_chance_says_the_same() -> None:
    one, other = liar(), liar()
    for _ in range(5):
        assert one.say(tuple(MOODS)) == other.say(tuple(MOODS))


def test_no_proof_is_right_though_the_key_of_a_simulated_drive_is_published() -> None:
    one = liar()
    proven = [
        (path, message)
        for path, payload in one.say((Mood.PROOFS,))
        if isinstance(message := decode(BY_PATH[path], payload), OpRequest) and message.proof
    ]
    assert proven
    for path, message in proven:
        kind = cast("OpKind", path.removeprefix("op/"))
        assert not authentic(VIRTUAL_KEY, kind, "r1", message.proof, message.id)


@pytest.mark.parametrize("mood", [Mood.CREEP, Mood.LEAP])
def test_a_forged_pose_comes_after_the_newest_and_is_elsewhere(mood: Mood) -> None:
    one = liar()
    newest = one.heard[keys.LOCALIZATION.path]
    said = [said for _ in range(5) for said in one.say((mood,))]
    payload = [payload for path, payload in said if path == keys.LOCALIZATION.path][-1]
    forged = decode(keys.LOCALIZATION, payload)
    assert not isinstance(forged, DecodeFailure)
    assert forged.seq > newest.seq
    assert forged.odom_in_map != newest.odom_in_map
