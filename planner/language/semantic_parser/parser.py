"""Read a sentence by the learned reader: its plan and how sure it is; the door of this folder.

It offers and never acts: what a sentence denies, hangs on or says of others' doings is judged by
whoever asks, for the network's confidence knows nothing of it. numpy is loaded with the first
sentence, not before. Where the model can't be used the reason is told once, and nothing is read.
"""

from __future__ import annotations

import logging
import os
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.semantic_parser.plan_grammar import ALONE
from planner.language.semantic_parser.units import MAX_UNITS, Gazetteer, cut_units

if TYPE_CHECKING:
    from collections.abc import Iterator

    from planner.language.semantic_parser.decoding import ParsedPlan
    from planner.language.semantic_parser.network import PointerNetwork
    from planner.plan import Vocabulary

LOG = logging.getLogger(__name__)
_THREADS = "OPENBLAS_NUM_THREADS"
MODEL = Path(__file__).with_name("reader_model.bin")
ORDERS_NOTHING = frozenset({"none", "refuse", "skip", "fact", "forget", "name_here", "here"}) | {
    form for form in ALONE if form.startswith("order")
}
"""Forms of a whole plan that leave the robot where it is; what changes a drive isn't among them."""


@contextmanager
def _one_thread() -> Iterator[None]:
    """Have numpy load its linear algebra for one thread.

    Its products are small here: threads that wait for each other on a busy processor made a
    sentence of 9 ms one of 400.
    """
    before = os.environ.get(_THREADS)
    os.environ[_THREADS] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[_THREADS]
        else:
            os.environ[_THREADS] = before


@lru_cache(maxsize=2)
def load_network(path: Path = MODEL) -> PointerNetwork | None:
    """Return the network of a file; None, told in the log, where it can't be used."""
    with _one_thread():
        from planner.language.semantic_parser.model_file import ModelFileError, read_model

    try:
        return read_model(path)
    except ModelFileError as error:
        LOG.warning("the learned reader is off: %s; templates read on", error)
        return None


@lru_cache(maxsize=4)
def names_of(vocabulary: Vocabulary) -> Gazetteer:
    """Return a site's spellings and the place that each means; what two places share means none."""
    found: dict[str, set[str]] = {}
    for entry in vocabulary.entries:
        for spelling in entry.spellings:
            found.setdefault(spelling, set()).add(entry.id)
    return Gazetteer({word: ids.pop() for word, ids in found.items() if len(ids) == 1})


def parse(
    sentence: str,
    vocabulary: Vocabulary,
    path: Path = MODEL,
    most: int = 1,
    least_confidence: float = 0.0,
) -> tuple[ParsedPlan, ...]:
    """Return the plans that a sentence may mean, the surest first; none where it is not read.

    Args:
        sentence: as it was said.
        vocabulary: of the site; a plan names its places by their ids.
        path: of the model.
        most: so many plans at most.
        least_confidence: nothing is read with less.
    """
    from planner.language.semantic_parser.decoding import decode_plans

    said = cut_units(sentence, names_of(vocabulary))
    network = load_network(path) if 0 < len(said.units) <= MAX_UNITS else None
    return decode_plans(network, said, most, least_confidence) if network is not None else ()


@lru_cache(maxsize=64)
def still_share(sentence: str, vocabulary: Vocabulary, path: Path = MODEL) -> float:
    """Return how likely it is that a sentence orders nothing to be driven now; 0: it isn't read.

    One action is written, not the plan: a quarter of the time that ``parse`` takes.
    """
    from planner.language.semantic_parser.decoding import first_forms

    said = cut_units(sentence, names_of(vocabulary))
    network = load_network(path) if 0 < len(said.units) <= MAX_UNITS else None
    forms = first_forms(network, said) if network is not None else {}
    return sum(forms.get(form, 0.0) for form in ORDERS_NOTHING)
