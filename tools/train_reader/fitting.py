"""Fit the network: batches by seed, a rate that rises and falls, the mean of late weights."""

from __future__ import annotations

import math
from random import Random
from typing import TYPE_CHECKING

import numpy as np
import torch

from planner.language.semantic_parser.features import (
    UNKNOWN,
    UnitFeatures,
    bucket_of,
    sentence_features,
)
from planner.language.semantic_parser.linear_plan import PARTS, TOKEN_NUMBERS, TOKENS
from tools.train_reader.joining import SentenceJoiner
from tools.train_reader.network import ExampleBatch, TrainableNetwork
from tools.train_reader.swapping import WordSwapper

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.train_reader.examples import PlanExample

BATCH = 64
RATE, BUCKET_RATE = 1.3e-3, 5e-3
"""A bucket is seen seldom, so that it must learn more of each time."""
WARM_UP = 0.05
LOST, UNKNOWN_WORDS = 0.1, 0.06
"""So many pieces and words of a sentence aren't seen, so that none is relied on alone."""
CHANGED = 0.4
"""So many sentences get other quoted words each time they are shown."""
JOINED = 0.15
"""So many get another sentence behind them."""
SMOOTHED = 0.05
KEPT, MEAN_EVERY = 0.98, 5
"""Of the running mean of weights, each so many steps."""


def make_batch(
    examples: Sequence[PlanExample], features: Sequence[Sequence[UnitFeatures]]
) -> ExampleBatch:
    """Return examples with their units' features as tensors."""
    units = max(len(example.said.units) for example in examples)
    length = max(len(example.actions) for example in examples)
    words: list[int] = []
    pieces: list[int] = []
    starts: list[int] = []
    unit_at: list[int] = []
    mask = torch.zeros(len(examples), units, dtype=torch.bool)
    written = torch.zeros(len(examples), length, dtype=torch.long)
    parts = torch.zeros(len(examples), length, dtype=torch.long)
    pointed = torch.full((len(examples), length), -1)
    is_told = np.zeros((len(examples), length, units), bool)
    wanted = torch.full((len(examples), length), -100)
    allowed = torch.zeros(len(examples), length, len(TOKENS) + units, dtype=torch.bool)
    for row, (example, of_units) in enumerate(zip(examples, features, strict=True)):
        mask[row, : len(of_units)] = True
        for at, of_unit in enumerate(of_units):
            words.append(of_unit.word)
            starts.append(len(pieces))
            pieces += of_unit.pieces
            unit_at.append(row * units + at)
        parts[row, : len(example.parts)] = torch.tensor(example.parts)
        for at, (action, (tokens, fitting)) in enumerate(
            zip(example.actions, example.allowed, strict=True)
        ):
            token = TOKEN_NUMBERS[action] if isinstance(action, str) else None
            unit = action if isinstance(action, int) else 0
            wanted[row, at] = len(TOKENS) + unit if token is None else token
            if at + 1 < length:
                written[row, at + 1] = -1 - unit if token is None else token + 1
            if token is None:
                is_last = PARTS[example.parts[at]][0] == "last"
                first = int(example.actions[at - 1]) if is_last else unit
                pointed[row, at + 1 :] = unit
                is_told[row, at + 1 :, first : unit + 1] = True
            allowed[row, at, tokens + [len(TOKENS) + unit for unit in fitting]] = True
        allowed[row, len(example.actions) :, 0] = True
    rows = [torch.tensor(each, dtype=torch.long) for each in (words, pieces, starts, unit_at)]
    told = torch.from_numpy(is_told)
    return ExampleBatch(
        rows[0], rows[1], rows[2], rows[3], mask, written, parts, pointed, told, wanted, allowed
    )


def _loss(logits: torch.Tensor, batch: ExampleBatch) -> torch.Tensor:
    """Return the cross entropy; what is smoothed goes to what is allowed."""
    log_shares = logits.log_softmax(2)
    is_action = batch.wanted >= 0
    picked = log_shares.gather(2, batch.wanted.clamp(min=0)[:, :, None])[:, :, 0]
    mean = log_shares.masked_fill(~batch.allowed, 0.0).sum(2) / batch.allowed.sum(2).clamp(min=1)
    smoothed = (1.0 - SMOOTHED) * picked + SMOOTHED * mean
    return -(smoothed * is_action).sum() / is_action.sum()


def make_optimizer(network: TrainableNetwork) -> torch.optim.Optimizer:
    """Return what fits a network: its buckets faster than all else."""
    buckets = network.tables()
    others = [each for each in network.parameters() if all(each is not table for table in buckets)]
    groups = [
        {"params": buckets, "lr": BUCKET_RATE, "weight_decay": 0.0},
        {"params": others, "lr": RATE},
    ]
    return torch.optim.AdamW(groups, RATE, weight_decay=0.02, fused=True)


def fit(
    examples: Sequence[PlanExample], epochs: int, seed: int, tell: Callable[[str], None]
) -> TrainableNetwork:
    """Return a network that was fitted to examples.

    Args:
        examples: to learn from.
        epochs: so often each is shown.
        seed: of first weights and order.
        tell: is told how it goes.
    """
    torch.manual_seed(seed)
    random = Random(seed)
    network = TrainableNetwork()
    mean = {name: weight.detach().clone() for name, weight in network.state_dict().items()}
    optimizer = make_optimizer(network)
    swapper, joiner = WordSwapper(examples), SentenceJoiner(examples)
    steps = epochs * math.ceil(len(examples) / BATCH)
    rate = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda step: _rate(step / steps))
    step = 0
    for epoch in range(epochs):
        order = sorted(
            range(len(examples)), key=lambda i: len(examples[i].said.units) + random.random() * 5
        )
        blocks = [order[at : at + BATCH] for at in range(0, len(order), BATCH)]
        random.shuffle(blocks)
        total = 0.0
        for block in blocks:
            shown = [_change(examples[i], swapper, joiner, random) for i in block]
            seen = [_lose(sentence_features(each.said.units), random) for each in shown]
            batch = make_batch(shown, seen)
            loss = _loss(network(batch), batch)
            total += loss.item()
            optimizer.zero_grad()
            loss.backward()
            torch.nn.utils.clip_grad_norm_(network.parameters(), 1.0)
            optimizer.step()
            rate.step()
            step += 1
            if step % MEAN_EVERY:
                continue
            kept = min(KEPT, step / (step + 50))
            with torch.no_grad():
                for name, weight in network.state_dict().items():
                    mean[name].lerp_(weight, 1.0 - kept)
        tell(f"epoch {epoch + 1} of {epochs}: loss {total / len(blocks):.3f}")
    network.load_state_dict(mean)
    network.eval()
    return network


def _rate(share: float) -> float:
    return share / WARM_UP if share < WARM_UP else 0.5 + 0.5 * math.cos(math.pi * min(share, 1.0))


def _change(
    example: PlanExample, swapper: WordSwapper, joiner: SentenceJoiner, random: Random
) -> PlanExample:
    changed = swapper.swap(example, random) if random.random() < CHANGED else example
    return joiner.join(changed, random) if random.random() < JOINED else changed


def _lose(features: list[UnitFeatures], random: Random) -> list[UnitFeatures]:
    """Return a sentence's features, some of them lost."""
    unknown = bucket_of(UNKNOWN)
    return [
        UnitFeatures(
            unknown if random.random() < UNKNOWN_WORDS else unit.word,
            tuple(piece for piece in unit.pieces if random.random() >= LOST),
        )
        for unit in features
    ]
