"""Fit the intent model and write it: ``python -m tools.train_intent [--steps N] [--model FILE]``.

Needs PyTorch in an environment of its own (README.md). Prints how phrases fare that were kept away
while a first network was fitted; the one that is written has seen all of them. By seed: the same
file on the same versions.
"""

from __future__ import annotations

import argparse
import json
from itertools import accumulate
from pathlib import Path
from random import Random

import numpy as np
import torch
from torch import Tensor, nn

from planner.language.grammar.guessed_order import NONE
from planner.language.intent.features import sentence_features, unit_features
from planner.language.intent.intent_model import MODEL, VERSION
from tools.train_intent.generator import Example, draw, intents
from tools.train_intent.network import EMBEDDED, HIDDEN, IntentNetwork

HELD = 0.25
BATCH = 128
MISSED = 0.15
"""Of a sentence's features in training, so that no single one decides."""
INT8 = 127


def _flat(lists: list[list[int]]) -> tuple[Tensor, Tensor]:
    begins = [0, *accumulate(len(one) for one in lists)][:-1]
    return torch.tensor([bucket for one in lists for bucket in one]), torch.tensor(begins)


def fit(steps: int, held: float, seed: int) -> IntentNetwork:
    """Return a network fitted on phrases that are not kept away."""
    torch.manual_seed(seed)
    random, names = Random(seed), intents()
    network = IntentNetwork(len(names))
    optimiser = torch.optim.AdamW(network.parameters(), weight_decay=0.02)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, 0.02, steps)
    judged, tagged = nn.CrossEntropyLoss(label_smoothing=0.05), nn.BCEWithLogitsLoss()
    network.train()
    for step in range(steps):
        examples = [draw(random, held) for _ in range(BATCH)]
        kept = [
            [one for one in sentence_features(e.units) if random.random() > MISSED] or [0]
            for e in examples
        ]
        asked = network.intent(*_flat(kept))
        loss = judged(asked, torch.tensor([names.index(e.intent) for e in examples]))
        some = examples[: BATCH // 4]
        spots = [unit_features(e.units, at) for e in some for at in range(len(e.units))]
        things = torch.tensor([float(one) for e in some for one in e.thing])
        loss = loss + tagged(network.thing(*_flat(spots)), things)
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        if step % 500 == 499:
            print(f"step {step + 1} of {steps}: loss {loss.item():.3f}", flush=True)
    network.eval()
    return network


def judge(network: IntentNetwork, held: float, seed: int, count: int = 6_000) -> None:
    """Print how phrases that were kept away are read, by how sure the network is."""
    random, names = Random(seed), intents()
    examples: list[Example] = [draw(random, held, from_held=True) for _ in range(count)]
    wanted = torch.tensor([names.index(one.intent) for one in examples])
    with torch.no_grad():
        scores = network.intent(*_flat([sentence_features(one.units) for one in examples]))
    best, found = torch.softmax(scores, 1).max(1)
    none = names.index(NONE)
    asks = wanted != none
    for least in (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9):
        offered = (best >= least) & (found != none)
        right = int((offered & (found == wanted)).sum())
        offers, in_vain = int(offered.sum()), int((offered & ~asks).sum())
        read, wrong = right / int(asks.sum()), 1 - right / max(1, offers)
        print(
            f"sure {least}: {read:.3f} of orders read; of {offers} guesses {wrong:.3f} wrong; "
            f"{in_vain / int((~asks).sum()):.3f} of what asks for nothing is guessed at"
        )


def write(network: IntentNetwork, path: Path) -> None:
    """Write a head of JSON, then the weights: int8 tables, float32 layers with their biases."""
    with torch.no_grad():
        embedding, scale = _int8(network.embedding.weight)
        tags, tag_scale = _int8(network.tags.weight)
        layers = [
            torch.cat((layer.weight, layer.bias.unsqueeze(1)), 1).numpy().astype("<f4").tobytes()
            for layer in (network.hidden, network.output)
        ]
    head = {
        "version": VERSION, "embedded": EMBEDDED, "hidden": HIDDEN, "intents": intents(),
        "scale": scale, "tag_scale": tag_scale, "tag_bias": network.tag_bias.item(),
    }  # fmt: skip
    path.write_bytes(json.dumps(head).encode() + b"\n" + embedding + tags + b"".join(layers))


def _int8(weight: Tensor) -> tuple[bytes, float]:
    scale = float(weight.abs().max()) / INT8
    return np.round(weight.numpy() / scale).astype(np.int8).tobytes(), scale


def main() -> None:
    """Judge on phrases kept away, then fit on all and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=1_500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", type=Path, default=MODEL)
    told = parser.parse_args()
    torch.set_num_threads(1)
    judge(fit(told.steps, HELD, told.seed), HELD, told.seed + 1)
    write(fit(told.steps, 0.0, told.seed), told.model)
    print(f"{told.model}: {told.model.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
