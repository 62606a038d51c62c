"""Fit the learned reader's network and write its file: ``python -m tools.train_reader``.

``--judge`` keeps every third writer away and says how their sentences are read.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import torch

from planner.language.semantic_parser.model_file import MODEL, read_model, write_model
from tools.train_reader.earlier_sentences import earlier_examples
from tools.train_reader.evaluation import judge, report
from tools.train_reader.examples import PlanExample, written_examples
from tools.train_reader.fitting import fit

SENTENCES = Path(__file__).parent / "sentences"
KEPT_AWAY = 3
UNREAD = frozenset({39, 40, 41, 42, 43, 44, 45, 47, 48})
"""Files that are taught to no reader: they tell how the shipped one reads people it never met."""


def is_kept_away(writer: str) -> bool:
    """Return whether a writer is one of those whose sentences judge."""
    return _number_of(writer) % KEPT_AWAY == 0


def _number_of(writer: str) -> int:
    return int(writer.strip("_enzh"))


def all_examples(folder: Path) -> list[PlanExample]:
    """Return what can be learnt from: the earlier sentences, and the files of a folder."""
    found = list(earlier_examples())
    for path in sorted(folder.glob("*_[0-9][0-9].tsv")):
        found += [] if _number_of(path.stem) in UNREAD else written_examples(path)
    return found


def main() -> None:
    """Fit, write, and judge where asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--epochs", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", type=Path, default=MODEL)
    parser.add_argument("--sentences", type=Path, default=SENTENCES)
    parser.add_argument("--judge", action="store_true", help="keep every third writer away")
    parser.add_argument("--share", type=float, default=1.0, help="of the examples to learn from")
    parser.add_argument("--threads", type=int, default=1)
    told = parser.parse_args()
    torch.set_num_threads(told.threads)
    began = time.monotonic()
    examples = all_examples(told.sentences)
    away = [each for each in examples if is_kept_away(each.writer)]
    known = [each for each in examples if not (told.judge and is_kept_away(each.writer))]
    known = known[: int(len(known) * told.share)]
    _tell(f"{len(known)} sentences to learn from, {len(away)} of writers kept away")
    network = fit(known, told.epochs, told.seed, _tell)
    write_model({name: w.numpy() for name, w in network.state_dict().items()}, told.model)
    size, spent = told.model.stat().st_size / 1e6, time.monotonic() - began
    _tell(f"{told.model.name}: {size:.2f} MB, {spent:.0f} s")
    if told.judge:
        reader, since = read_model(told.model), time.monotonic()
        verdicts = judge(reader, away)
        _tell(f"{1000 * (time.monotonic() - since) / len(away):.2f} ms a sentence")
        report(verdicts, _tell)


def _tell(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
