"""Read and write the network's file: 8-bit weights, the grammar they are for, a checksum.

A file that is missing, torn or made for another grammar is told with its reason; the caller goes on
without the learned reader.
"""

from __future__ import annotations

import json
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from planner.language.semantic_parser.features import BUCKETS
from planner.language.semantic_parser.linear_plan import PARTS, TOKENS
from planner.language.semantic_parser.network import Int8Matrix, PointerNetwork

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

MODEL = Path(__file__).with_name("reader_model.bin")
MAGIC = b"PONS reader 3\n"
MAX_BYTES = 4_000_000
_CHECKSUM_BYTES = 4


class ModelFileError(ValueError):
    """Tell why a model file can't be used."""


def grammar_version() -> int:
    """Return a number that differs where tokens, parts or features differ."""
    return crc32("\n".join((*TOKENS, *map(str, PARTS), str(BUCKETS))).encode())


def quantise(weights: NDArray[np.float32]) -> Int8Matrix:
    """Return a matrix in 8-bit whole numbers, each row by its greatest weight."""
    greatest = np.abs(weights).max(axis=1)
    scales = np.where(greatest > 0.0, greatest / 127.0, 1.0).astype(np.float32)
    return Int8Matrix(np.rint(weights / scales[:, None]).astype(np.int8), scales)


def write_model(weights: Mapping[str, NDArray[np.float32]], path: Path) -> None:
    """Write a network's weights by name."""
    header: dict[str, list[int]] = {}
    body = b""
    for name, values in sorted(weights.items()):
        header[name] = list(values.shape)
        if values.ndim == 1:
            body += values.astype("<f4").tobytes()
        else:
            matrix = quantise(values)
            body += matrix.scales.astype("<f4").tobytes() + matrix.values.tobytes()
    head = json.dumps({"grammar": grammar_version(), "shapes": header}).encode()
    whole = MAGIC + len(head).to_bytes(4, "little") + head + body
    path.write_bytes(whole + crc32(whole).to_bytes(_CHECKSUM_BYTES, "little"))


def read_model(path: Path = MODEL) -> PointerNetwork:
    """Return the network of a file.

    Raises:
        ModelFileError: it is missing, torn, or made for another grammar.
    """
    try:
        whole = path.read_bytes()
    except OSError as error:
        raise ModelFileError(f"{path.name} can't be read: {error.strerror}") from error
    told, body = whole[:-_CHECKSUM_BYTES], whole[-_CHECKSUM_BYTES:]
    if not whole.startswith(MAGIC) or len(whole) > MAX_BYTES:
        raise ModelFileError(f"{path.name} is not a reader's model of this version")
    if crc32(told) != int.from_bytes(body, "little"):
        raise ModelFileError(f"{path.name} is torn: its checksum differs")
    begin = len(MAGIC) + 4
    end = begin + int.from_bytes(told[len(MAGIC) : begin], "little")
    head = json.loads(told[begin:end])
    if head["grammar"] != grammar_version():
        raise ModelFileError(f"{path.name} was made for another plan grammar")
    return _network_of(head["shapes"], told[end:])


def _network_of(shapes: Mapping[str, list[int]], body: bytes) -> PointerNetwork:
    matrices: dict[str, Int8Matrix] = {}
    vectors: dict[str, NDArray[np.float32]] = {}
    at = 0
    for name, shape in shapes.items():
        floats = np.frombuffer(body, "<f4", shape[0], at).astype(np.float32)
        at += 4 * shape[0]
        if len(shape) == 1:
            vectors[name] = floats
            continue
        values = np.frombuffer(body, np.int8, prod(shape), at).reshape(shape)
        at += prod(shape)
        matrices[name] = Int8Matrix(values, floats)
    return PointerNetwork(matrices, vectors)
