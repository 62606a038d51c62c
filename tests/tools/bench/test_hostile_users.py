"""The table of hostile users counts what was judged, and keeps the drive's own user apart."""

from __future__ import annotations

from typing import Any

from tools.bench.hostile.draw import OF_THE_DRIVE, draw
from tools.bench.measure.hostile_users import rows
from tools.bench.report import ReportRow

PLAIN: dict[str, Any] = {
    "doors": ["bridge"], "http_lost": False, "did": {"said": 10}, "contacts": 0, "too_fast": False,
    "outside": False, "outside_m": 0.0, "by_hand_m": 0.0, "metres": 1.0, "after_stop": "",
    "gripped": False, "took_s": 0.05, "hidden": "", "moving": True, "rows": ["CMD_BAD"],
    "load": 1.0,
}  # fmt: skip


def told(number: int, **more: Any) -> dict[str, Any]:
    return {**draw(number).record(), **PLAIN, **more}


def table(played: list[dict[str, Any]]) -> dict[str, ReportRow]:
    return {row.what.strip(): row for row in rows(played)}


def test_zeros_say_among_how_many_and_the_drives_user_is_not_among_them() -> None:
    found = table([told(n) for n in range(300)] + [told(OF_THE_DRIVE, contacts=3, too_fast=True)])
    assert found["unsafe motion"].value.startswith("0 of 300 (< 1.00%")
    assert found["stop hidden from a person"].value.startswith("0 of 300 ")
    assert found["moved after it by a stick gripped anew"].value.startswith("0 of 300 ")
    assert found["pons-planner"].value.startswith("0 of 100 ")
    assert found["pons-sim"].value == "contact 1, faster than the cap 1"
    assert found["pons-sim"].goal == ""


def test_what_went_wrong_is_counted_and_named() -> None:
    found = table(
        [
            told(0, contacts=1),
            told(1, outside=True, outside_m=0.3),
            told(2, hidden="never confirmed", took_s=None),
            told(4, took_s=2.0, load=9.0),
            told(5, gripped=True),
        ]
    )
    assert found["unsafe motion"].value == "2 of 5"
    assert "#0 pons-planner: ['contact']" in found["unsafe motion"].note
    assert found["stop hidden from a person"].value == "1 of 5"
    assert found["stop later than 1.5 s"].value == "2 of 5"
    assert "reaches no door: 1" in found["stop later than 1.5 s"].note
    assert found["moved after it by a stick gripped anew"].value == "1 of 5"
    assert found["pons-localization"].value == "outside of the fence 1"
    assert "at most 0.300 m outside" in found["pons-localization"].note
