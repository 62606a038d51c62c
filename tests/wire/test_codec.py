"""What the codec accepts is in schema and bounds; everything else is refused as a value."""

from __future__ import annotations

import json

import pytest

from tests.wire.codec_fuzz import fuzz
from tests.wire.examples import EXAMPLES
from wire import DecodeFailure, Image, ImageHeader, Record, Stop, Waypoints, decode, encode
from wire.codec import image
from wire.keys import CAMERA_COLOR, IMAGE, KEYS, LOCALIZATION, SMALL, STOP, WAYPOINTS, Key


@pytest.fixture(params=KEYS, ids=lambda key: key.path)
def key(request: pytest.FixtureRequest) -> Key[Record]:
    found: Key[Record] = request.param
    return found


def test_every_message_survives_the_round_trip(key: Key[Record]) -> None:
    message = EXAMPLES[key.message]
    assert decode(key, encode(message)) == message


def test_every_message_fits_its_key(key: Key[Record]) -> None:
    assert len(encode(EXAMPLES[key.message])) <= key.max_bytes


def test_unknown_fields_are_refused(key: Key[Record]) -> None:
    body = json.loads(encode(EXAMPLES[key.message])) | {"unasked": 1}
    answer = decode(key, json.dumps(body).encode())
    assert isinstance(answer, DecodeFailure)
    assert "unasked" in answer.detail


def test_a_missing_field_without_a_default_is_refused(key: Key[Record]) -> None:
    body = json.loads(encode(EXAMPLES[key.message]))
    for name, field in key.message.model_fields.items():
        if field.is_required():
            short = {k: v for k, v in body.items() if k != name}
            assert isinstance(decode(key, json.dumps(short).encode()), DecodeFailure), name


@pytest.mark.parametrize("literal", [b"NaN", b"Infinity", b"-Infinity", b"1e999", b"-1e999"])
def test_numbers_that_are_none_are_refused(literal: bytes) -> None:
    good = encode(EXAMPLES[LOCALIZATION.message])
    assert isinstance(decode(LOCALIZATION, good.replace(b"0.9", literal)), DecodeFailure)


@pytest.mark.parametrize(
    "payload",
    [b"", b"\x00", b"{}", b"null", b"[]", b"\xff\xfe", b'{"id":', b"[" * 4000, b'{"a":' * 800],
)
def test_what_is_no_message_is_refused(payload: bytes) -> None:
    answer = decode(STOP, payload)
    assert isinstance(answer, DecodeFailure)
    assert answer.code == "invalid"


def test_size_is_judged_before_parsing() -> None:
    answer = decode(STOP, b" " * (STOP.max_bytes + 1))
    assert answer == DecodeFailure("too_large", "cmd/stop: 4097 bytes, at most 4096")


def test_a_string_is_no_number_and_a_number_no_flag() -> None:
    good = encode(EXAMPLES[Waypoints])
    assert isinstance(decode(WAYPOINTS, good.replace(b'"seq":5', b'"seq":"5"')), DecodeFailure)
    assert isinstance(decode(WAYPOINTS, good.replace(b'"final":true', b'"final":1')), DecodeFailure)


def test_too_many_points_are_refused() -> None:
    body = json.loads(encode(EXAMPLES[Waypoints]))
    body["points"] = [{"x_m": 0.1 * n, "y_m": 0.0, "speed_mps": 0.3} for n in range(51)]
    assert isinstance(decode(WAYPOINTS, json.dumps(body).encode()), DecodeFailure)
    body["points"].pop()
    assert isinstance(decode(WAYPOINTS, json.dumps(body).encode()), Waypoints)


def test_a_picture_is_its_header_and_its_bytes() -> None:
    header = EXAMPLES[ImageHeader]
    assert image(CAMERA_COLOR, encode(header), b"x") == Image(header, b"x")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("attached", "payload", "code"),
    [
        (b"", b"x", "invalid"),
        (b"{}", b"x", "invalid"),
        (encode(EXAMPLES[ImageHeader]).replace(b"320", b"0"), b"x", "invalid"),
        (encode(EXAMPLES[ImageHeader]).replace(b"320", b"50000"), b"x", "invalid"),
        (encode(EXAMPLES[ImageHeader]).replace(b"277.0", b"NaN"), b"x", "invalid"),
        (encode(EXAMPLES[ImageHeader]), b"", "invalid"),
        (encode(EXAMPLES[ImageHeader]), bytes(IMAGE + 1), "too_large"),
        (b" " * (SMALL + 1), b"x", "too_large"),
    ],
)
def test_what_is_no_picture_is_refused_as_a_value(
    attached: bytes, payload: bytes, code: str
) -> None:
    answer = image(CAMERA_COLOR, attached, payload)
    assert isinstance(answer, DecodeFailure)
    assert answer.code == code


def test_nesting_too_deep_for_the_parser_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    class Deep:
        def validate_json(self, _payload: bytes, *, strict: bool) -> object:
            raise RecursionError(strict)

    monkeypatch.setattr(Stop, "__pydantic_validator__", Deep())
    answer = decode(STOP, b"{}")
    assert isinstance(answer, DecodeFailure)
    assert "nested" in answer.detail


def test_five_thousand_spoilt_messages_are_refused_or_sound() -> None:
    told = fuzz(7, 5_000, EXAMPLES)
    assert told["tried"] == 5_000
    assert told["bad"] == 0
    assert told["accepted"] > 100, "or nothing was judged"
    assert told["grown_kib"] < 4_096
