"""Every code that a person may meet has a sentence in both languages, here and on the page."""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path

import pytest

from bridge.core.authority import epoch as epoch_module
from bridge.core.authority import requests
from bridge.core.faults.code_messages import FAULTS, GATES, ORDERS, REFUSALS, SENTENCES, WANTS
from bridge.core.faults.fault_messages import WORDS
from bridge.core.modes import mode_logic, operator, selftest
from bridge.core.sensing import sensor_update
from bridge.recording import writer
from bridge.recording.health import DOWN
from scripts.page_words import CODES, ROWS, codes_json, rows_json

CODE = re.compile(r"[a-z]+(_[a-z]+)+")
TABLES = {"orders": ORDERS, "gates": GATES, "faults": FAULTS, "wants": WANTS, "refusals": REFUSALS}


def codes_in(module: object, *functions: str) -> set[str]:
    """Return the codes that these functions of a module may give, read from its source."""
    tree = ast.parse(Path(str(module.__file__)).read_text("utf-8"))  # type: ignore[attr-defined]
    chosen = [n for n in tree.body if isinstance(n, ast.FunctionDef) and n.name in functions]
    assert len(chosen) == len(functions), "a function has another name now"
    nodes = [node for function in chosen for node in ast.walk(function)]
    texts = {n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str)}
    found = {text for text in texts if CODE.fullmatch(text)}
    for node in nodes:
        said = node.value if isinstance(node, ast.Yield) else None
        first = said.elts[0] if isinstance(said, ast.Tuple) else said
        if isinstance(first, ast.Constant) and isinstance(first.value, str):
            found.add(first.value)
    return found


def test_what_a_self_test_waits_for_or_faults_has_words() -> None:
    waits = codes_in(selftest, "waits_for", "_untold")
    assert {"drive", "lidar", "estop_link", "stop_input"} < waits
    assert waits <= set(WANTS)
    wrong = codes_in(selftest, "_wrong")
    assert {"drive_no_timeout", "drive_moves_on", "encoders_moving"} < wrong
    assert wrong <= set(FAULTS)


def test_what_ends_a_stop_in_fault_has_words() -> None:
    assert codes_in(mode_logic, "_failure") == {"stop_too_slow", "stop_too_long"} <= set(FAULTS)


def test_what_keeps_a_robot_from_arming_or_a_reset_has_words() -> None:
    lacks = codes_in(operator, "arm_lacks", "ready_lacks", "reset_lacks")
    lacks |= codes_in(sensor_update, "recorder_lack")
    assert {"fence_changing", "recorder_down", "estop_just_released"} < lacks
    assert lacks <= set(WANTS) | set(REFUSALS)
    assert {DOWN, "disk_full"} <= set(WANTS)
    assert "disk_full" in Path(writer.__file__).read_text("utf-8")


def test_what_refuses_a_hello_or_an_order_has_words() -> None:
    hello = codes_in(epoch_module, "_against")
    assert {"robot_mismatch", "fence_mismatch", "map_mismatch", "owner_alive"} < hello
    order = codes_in(operator, "_against") | codes_in(requests, "bad_proof")
    assert {"bad_proof", "stopped"} < order
    assert hello | order <= set(REFUSALS) | set(WANTS)


@pytest.mark.parametrize("name", TABLES)
def test_each_word_is_in_its_language(name: str) -> None:
    for code, (en, zh) in TABLES[name].items():
        assert en.isascii(), code
        assert re.search(r"[\u4e00-\u9fff]", zh), code
        if name != "wants":
            assert en.endswith("."), code
            assert zh.endswith("。"), code
        assert not re.search(r"emergency|certified|紧急|急停", en + zh), code


def test_a_code_has_one_sentence_and_is_no_row() -> None:
    sentences = [code for name, table in TABLES.items() if name != "wants" for code in table]
    assert sorted(sentences) == sorted(SENTENCES)
    assert not {code.upper() for code in SENTENCES} & set(WORDS)


def test_the_page_has_the_same_words() -> None:
    again = "run python -m scripts.page_words"
    assert CODES.read_text("utf-8") == codes_json(), again
    assert ROWS.read_text("utf-8") == rows_json(), again
    shown = json.loads(codes_json())
    assert shown["wants"]["drive_echo"] == {"en": "the drive's answer", "zh": "驱动应答"}
    assert set(shown["sentences"]) == set(SENTENCES)
