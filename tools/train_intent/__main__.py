"""Fit the intent model and write it: ``python -m tools.train_intent [--steps N] [--model FILE]``.

Needs PyTorch in an environment of its own (README.md). ``--judge`` prints instead how sentences of
writers fare who were kept away. By seed: the same file on the same versions.
"""

from __future__ import annotations

import argparse
import json
from functools import partial
from itertools import accumulate
from pathlib import Path
from random import Random

import numpy as np
import torch
from torch import Tensor, nn

from planner.language.grammar.guessed_order import ORDERS, admit_intents
from planner.language.intent.features import sentence_features
from planner.language.intent.intent_model import (
    MODEL,
    NAME,
    THING,
    VERSION,
    WORDS,
    IntentModel,
    load_intent_model,
)
from tools.train_intent.generator import Example, draw, intents, said_by_people, writers
from tools.train_intent.network import EMBEDDED, HIDDEN, IntentNetwork
from tools.train_intent.slots import fit_slots

KEPT_AWAY = 6
"""Every so many-th writer of a language is kept away to judge by."""
DRAWN = 4_000
"""Examples from phrases that labels are fitted on, beside the sentences."""
BATCH = 128
MISSED = 0.2
"""Of a sentence's features in training, so that no single one decides."""
INT8 = 127


def _flat(lists: list[list[int]]) -> tuple[Tensor, Tensor]:
    begins = [0, *accumulate(len(one) for one in lists)][:-1]
    return torch.tensor([bucket for one in lists for bucket in one]), torch.tensor(begins)


def fit(steps: int, away: frozenset[str], seed: int) -> IntentNetwork:
    """Return a network fitted without the sentences of these writers."""
    torch.manual_seed(seed)
    random, names = Random(seed), intents()
    network = IntentNetwork(len(names))
    optimiser = torch.optim.AdamW(network.parameters(), weight_decay=0.02)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, 0.02, steps)
    judged = nn.CrossEntropyLoss(label_smoothing=0.05)
    network.train()
    for step in range(steps):
        examples = [draw(random, away) for _ in range(BATCH)]
        kept = [
            [one for one in sentence_features(e.units) if random.random() > MISSED] or [0]
            for e in examples
        ]
        asked = network.intent(*_flat(kept))
        loss = judged(asked, torch.tensor([names.index(e.intent) for e in examples]))
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        if step % 500 == 499:
            print(f"intents, step {step + 1} of {steps}: loss {loss.item():.3f}", flush=True)
    network.eval()
    return network


def label(away: frozenset[str], seed: int) -> IntentModel:
    """Return the labels fitted without the sentences of these writers."""
    random = Random(seed)
    said = [one.example for one in said_by_people() if one.writer not in away]
    drawn = [draw(random, frozenset(writers())) for _ in range(DRAWN)]
    return fit_slots([*said, *drawn], seed, tell=partial(print, flush=True))


def judge(model: IntentModel, away: frozenset[str]) -> None:
    """Print how the sentences of these writers are read, by how sure the model is."""
    for language in ("en", "zh"):
        said = [
            one.example
            for one in said_by_people()
            if one.writer in away and one.language == language
        ]
        guesses = [model.guess(e.units, admit_intents(_places(e))) for e in said]
        right = sum(g.intent == e.intent for g, e in zip(guesses, said, strict=True))
        print(f"{language}: {right} of {len(said)} intents right")
        for least in (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9):
            sure = [(g, e) for g, e in zip(guesses, said, strict=True) if g.share >= least]
            for what, of in (("orders", True), ("others", False)):
                told = [(g, e) for g, e in sure if (g.intent in ORDERS) is of]
                hit = sum(g.intent == e.intent for g, e in told)
                asked = sum((e.intent in ORDERS) is of for e in said)
                print(f"  sure {least}, {what}: {len(told)} guessed, {hit} right; said {asked}")
        for kind, name in ((THING, "thing"), (WORDS, "words"), (NAME, "name")):
            slots = [(model.label(e.units, e.intent), e.labels) for e in said if kind in e.labels]
            same = sum([x == kind for x in a] == [x == kind for x in b] for a, b in slots)
            print(f"  {name}: {same} of {len(slots)} cut out exactly")


def _places(example: Example) -> int:
    return len({unit for unit in example.units if unit[0] == "<"})


def write(network: IntentNetwork, slots: IntentModel, path: Path) -> None:
    """Write a head of JSON, then the weights: int8 tables, float32 layers with their biases."""
    with torch.no_grad():
        embedding, scale = _int8(network.embedding.weight.numpy())
        table, slot_scale = _int8(np.array([list(row) for row in slots.slots]))
        layers = [
            torch.cat((layer.weight, layer.bias.unsqueeze(1)), 1).numpy().astype("<f4").tobytes()
            for layer in (network.hidden, network.output)
        ]
    head = {
        "version": VERSION, "embedded": EMBEDDED, "hidden": HIDDEN, "intents": intents(),
        "scale": scale, "slot_scale": slot_scale, "transitions": slots.transitions,
    }  # fmt: skip
    path.write_bytes(json.dumps(head).encode() + b"\n" + embedding + table + b"".join(layers))


def _int8(weight: np.ndarray) -> tuple[bytes, float]:
    """Return a table in 255 steps; the rare weights beyond are cut to the outermost."""
    scale = float(np.quantile(np.abs(weight[weight != 0]), 0.9999)) / INT8
    return np.clip(np.round(weight / scale), -INT8, INT8).astype(np.int8).tobytes(), scale


def main() -> None:
    """Judge by writers kept away, or fit on all and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", type=Path, default=MODEL)
    parser.add_argument("--judge", action="store_true", help="keep writers away, and write to FILE")
    told = parser.parse_args()
    torch.set_num_threads(1)
    away = frozenset(w for w in writers() if int(w[2:]) % KEPT_AWAY == 0 and told.judge)
    write(fit(told.steps, away, told.seed), label(away, told.seed), told.model)
    if told.judge and (model := load_intent_model(told.model)) is not None:
        judge(model, away)
    print(f"{told.model}: {told.model.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
