"""A network comes back from its file; what can't be used is told with its reason."""

from __future__ import annotations

from pathlib import Path
from zlib import crc32

import pytest

from planner.language.semantic_parser.decoding import decode_plans
from planner.language.semantic_parser.model_file import ModelFileError, read_model, write_model
from planner.language.semantic_parser.parser import load_network
from planner.language.semantic_parser.units import Gazetteer, cut_units
from tests.planner.language.semantic_parser.drawn_network import draw_weights

SAID = cut_units("go to the kitchen twice", Gazetteer({"kitchen": "kitchen"}))


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.bin"
    write_model(draw_weights(1), path)
    return path


def test_the_same_weights_make_the_same_file(model: Path, tmp_path: Path) -> None:
    write_model(draw_weights(1), tmp_path / "other.bin")
    assert model.read_bytes() == (tmp_path / "other.bin").read_bytes()
    assert decode_plans(read_model(model), SAID) == decode_plans(read_model(model), SAID)


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(ModelFileError, match="can't be read"):
        read_model(tmp_path / "none.bin")


@pytest.mark.parametrize("cut", [0, 1, 13, 40, 5000, -1])
def test_a_torn_file_is_told(model: Path, cut: int) -> None:
    model.write_bytes(model.read_bytes()[:cut])
    with pytest.raises(ModelFileError):
        read_model(model)


def test_one_wrong_byte_is_told(model: Path) -> None:
    whole = bytearray(model.read_bytes())
    whole[len(whole) // 2] ^= 1
    model.write_bytes(bytes(whole))
    with pytest.raises(ModelFileError, match="torn"):
        read_model(model)


def test_a_file_of_another_grammar_is_told(model: Path) -> None:
    whole = model.read_bytes()[:-4].replace(b'{"grammar": ', b'{"grammar":9', 1)
    model.write_bytes(whole + crc32(whole).to_bytes(4, "little"))
    with pytest.raises(ModelFileError, match="another plan grammar"):
        read_model(model)


def test_the_reader_is_off_where_its_file_is_missing(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    assert load_network(tmp_path / "none.bin") is None
    assert "the learned reader is off" in caplog.text
