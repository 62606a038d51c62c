"""The voice route: what a recording must be, and what becomes of what is heard."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.api import Access
from planner.api.access import AccessError
from planner.api.middleware import MAX_BODY_BYTES
from planner.plan import Language
from planner.voice import MAX_BYTES, Recognition, VoiceAbilities, VoiceFailure
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of, code
from tests.planner.voice.speech import wav
from tests.wire.examples import STATUS

WAV = {"content-type": "audio/wav"}
SECOND = wav(bytes(32_000))
FREE = STATUS.model_copy(update={"held": None})


@pytest.fixture
def services() -> FakeServices:
    return FakeServices(FREE)


@pytest.mark.parametrize("kind", ["audio/wav", "audio/x-wav", "audio/wav; codecs=1", "Audio/WAVE"])
def test_what_is_heard_becomes_a_goal(
    client: TestClient, services: FakeServices, kind: str
) -> None:
    headers = {"content-type": kind, "Idempotency-Key": "k"}
    answer = client.post("/v1/voice?confirm=true&replace=true", content=SECOND, headers=headers)
    assert answer.status_code == 202
    body = answer.json()
    assert body["transcript"] == body["understood"] == body["goal"]["text"] == "go to the kitchen"
    assert body["confidence"] == 0.9
    assert body["outcome"]["code"] == "heard"
    assert services.goals.calls == [
        ("submit", "go to the kitchen", Language.EN, True, True, "k"),
    ]
    assert services.ears.sounds[0].seconds == 1.0


def test_what_is_not_heard_is_an_outcome_and_no_goal(
    client: TestClient, services: FakeServices
) -> None:
    services.ears.heard = Recognition("go to the kitchen", 0.3, understood=False)
    answer = client.post("/v1/voice", content=SECOND, headers=WAV)
    assert answer.status_code == 200
    body = answer.json()
    assert body["outcome"]["code"] == "not_heard"
    assert body["outcome"]["message"]["en"]
    assert body["outcome"]["message"]["zh"]
    assert (body["goal"], body["understood"], body["transcript"]) == (
        None,
        None,
        "go to the kitchen",
    )
    assert services.goals.calls == []


@pytest.mark.parametrize(
    ("languages", "instead_of", "typed"),
    [
        ((Language.EN,), None, True),
        ((Language.EN, Language.ZH), None, False),
        ((Language.EN, Language.ZH), "server", True),
    ],
)
def test_chinese_is_to_be_typed_only_where_nothing_hears_it(
    client: TestClient,
    services: FakeServices,
    languages: tuple[Language, ...],
    instead_of: Any,
    typed: bool,
) -> None:
    services.voice = VoiceAbilities(languages=languages)
    services.ears.heard = Recognition("", 0.0, understood=False, instead_of=instead_of)
    told = client.post("/v1/voice", content=SECOND, headers=WAV).json()["outcome"]["message"]
    assert ("中文目前请用文字输入" in told["zh"]) is typed


def test_what_is_heard_but_not_surely_waits_for_a_yes(
    client: TestClient, services: FakeServices
) -> None:
    services.ears.heard = Recognition("go to the kitchen", 0.6, understood=True)
    assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
    services.ears.heard = Recognition("yes", 0.6, understood=True)  # so it answers nothing
    assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
    services.ears.heard = Recognition("stop", 0.6, understood=True)
    assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
    assert [(call[1], call[3]) for call in services.goals.calls] == [
        ("go to the kitchen", True),
        ("yes", True),
        ("stop", False),
    ]


def test_a_chinese_recording_becomes_a_chinese_goal_and_who_heard_it_is_told(
    client: TestClient, services: FakeServices
) -> None:
    services.ears.heard = Recognition("去厨房", 0.9, True, Language.ZH, "server")
    body = client.post("/v1/voice", content=SECOND, headers=WAV).json()
    assert (body["language"], body["recogniser"], body["trouble"]) == ("zh", "server", None)
    assert services.goals.calls[0][:3] == ("submit", "去厨房", Language.ZH)
    services.ears.heard = Recognition(
        "go home", 0.9, True, instead_of="server", trouble="transcription_timeout"
    )
    body = client.post("/v1/voice", content=SECOND, headers=WAV).json()
    told = (body["recogniser"], body["instead_of"], body["trouble"])
    assert told == ("grammar", "server", "transcription_timeout")


def test_who_speaks_to_the_robot_is_not_spoken_over(
    client: TestClient, services: FakeServices
) -> None:
    assert client.post("/v1/voice/hush", json={}).status_code == 200
    assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
    assert services.speaker.hushed == 2


def test_a_page_learns_what_is_heard_and_spoken(client: TestClient, services: FakeServices) -> None:
    assert client.get("/v1/voice").json() == {
        "languages": ["en"], "recogniser": "grammar", "host": None,
        "speaks": "none", "quiet": False, "trouble": None,
    }  # fmt: skip
    services.voice = VoiceAbilities(languages=tuple(Language), host="voices.example")
    assert client.get("/v1/voice").json()["languages"] == ["en", "zh"]


def test_a_yes_or_no_is_looked_for_while_a_question_waits_for_one(
    client: TestClient, services: FakeServices
) -> None:
    for services.goals.asks in (False, True):
        assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
    assert services.ears.awaited == [False, True]


def test_a_spoken_stop_carries_no_act_that_clears_a_hold() -> None:
    services = FakeServices(STATUS)  # held
    services.ears.heard = Recognition("stop now", 0.6, understood=True)
    with client_of(services) as client:
        assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
        services.ears.heard = Recognition("go home", 0.6, understood=True)
        assert client.post("/v1/voice", content=SECOND, headers=WAV).status_code == 202
    assert [act is None for act in services.goals.acts] == [True, False]


@pytest.mark.parametrize(
    ("data", "status", "stable"),
    [
        (b"", 400, "audio_empty"),
        (SECOND[:20], 400, "wav_truncated"),
        (SECOND[:44], 400, "audio_too_short"),
        (b"OggS" + bytes(99), 415, "not_wav"),
        (wav(bytes(32_000), width=1), 415, "wav_unsupported"),
        (wav(bytes(300_000), 8_000), 413, "audio_too_long"),
        (wav(b""), 400, "audio_too_short"),
        (bytes(MAX_BYTES + 1), 413, "body_too_large"),
    ],
)
def test_a_bad_recording_is_a_problem(
    client: TestClient, services: FakeServices, data: bytes, status: int, stable: str
) -> None:
    answer = client.post("/v1/voice", content=data, headers=WAV)
    assert (answer.status_code, code(answer)) == (status, stable)
    assert services.ears.sounds == []
    assert services.goals.calls == []


def test_a_body_of_100_mb_is_cut_off_while_it_comes(client: TestClient) -> None:
    sent = 0

    def endless() -> Iterator[bytes]:
        nonlocal sent
        for _ in range(100):
            sent += 1
            yield bytes(1_000_000)

    answer = client.post("/v1/voice", content=endless(), headers=WAV)
    assert (answer.status_code, code(answer)) == (413, "body_too_large")


def test_only_voice_may_be_so_large(client: TestClient) -> None:
    json = {"content-type": "application/json"}
    answer = client.post("/v1/goals", content=b" " * (MAX_BODY_BYTES + 1), headers=json)
    assert code(answer) == "body_too_large"
    long_enough = wav(bytes(32_000 * 14))
    assert len(long_enough) > MAX_BODY_BYTES
    assert client.post("/v1/voice", content=long_enough, headers=WAV).status_code == 202


@pytest.mark.parametrize(
    "kind", ["", "application/json", "audio/ogg", "audio/webm;codecs=opus", "text/plain"]
)
def test_another_type_is_refused(client: TestClient, kind: str) -> None:
    answer = client.post("/v1/voice", content=SECOND, headers={"content-type": kind})
    assert (answer.status_code, code(answer)) == (415, "unsupported_media_type")


def test_sound_is_taken_nowhere_else() -> None:
    headers = {"host": "127.0.0.1", **WAV}
    with pytest.raises(AccessError, match="unsupported_media_type"):
        Access("127.0.0.1").judge("POST", "/v1/goals", headers)


@pytest.mark.parametrize("stable", ["recogniser_unavailable", "voice_busy", "voice_timed_out"])
def test_a_recogniser_that_fails_says_so(
    client: TestClient, services: FakeServices, stable: str
) -> None:
    services.ears.heard = VoiceFailure(stable, "because")
    answer = client.post("/v1/voice", content=SECOND, headers=WAV)
    assert (answer.status_code, code(answer)) == (503, stable)
    assert services.goals.calls == []
