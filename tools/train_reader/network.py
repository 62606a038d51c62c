"""Own the pointer network in PyTorch, name for name as ``planner`` runs it in numpy."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from planner.language.semantic_parser.features import BUCKETS
from planner.language.semantic_parser.linear_plan import PARTS, TOKENS
from planner.language.semantic_parser.network import DISTANCES, FARTHEST, HEADS

WIDTH = 160
FELT = 96
"""Numbers a bucket."""
ENCODER_LAYERS, DECODER_LAYERS = 3, 1
DROPPED = 0.15


@dataclass(frozen=True, slots=True)
class ExampleBatch:
    """Hold several examples as tensors."""

    words: Tensor
    """All units' words in one row."""
    pieces: Tensor
    """All units' pieces in one row."""
    starts: Tensor
    """Where the pieces of each unit begin."""
    unit_at: Tensor
    """(units of all sentences): where each stands in (sentence, unit)."""
    mask: Tensor
    """(sentences, units): whether there is a unit."""
    written: Tensor
    """(sentences, actions): the action before; a token's number + 1, or -1 - unit."""
    parts: Tensor
    """(sentences, actions): which part of the plan comes next."""
    pointed: Tensor
    """(sentences, actions): the unit that was pointed at last before; -1: none."""
    is_told: Tensor
    """(sentences, actions, units): whether it was pointed at before, or stands in quoted words."""
    wanted: Tensor
    """(sentences, actions): the index among tokens and then units; -100: none."""
    allowed: Tensor
    """(sentences, actions, tokens + units)."""


def _attend(query: Tensor, key: Tensor, value: Tensor, bias: Tensor) -> Tensor:
    """Return (sentences, rows, width) of what (sentences, heads, rows, part) hear."""
    heard = functional.scaled_dot_product_attention(query, key, value, attn_mask=bias)
    return heard.transpose(1, 2).flatten(2)


def _heads(values: Tensor) -> Tensor:
    count, rows, width = values.shape
    return values.view(count, rows, HEADS, width // HEADS).transpose(1, 2)


def _distances(batch: ExampleBatch) -> Tensor:
    """Return (sentences, actions, units): the column of a unit's distance from the last pointed."""
    units = torch.arange(batch.mask.shape[1])[None, None]
    apart = (units - batch.pointed[..., None]).clamp(-FARTHEST, FARTHEST) + FARTHEST
    return apart.masked_fill((batch.pointed < 0)[..., None], 2 * FARTHEST + 1)


class Layer(nn.Module):
    """Let rows look at each other."""

    def __init__(self) -> None:
        super().__init__()
        self.norm1, self.norm2 = nn.LayerNorm(WIDTH), nn.LayerNorm(WIDTH)
        self.mix, self.join = nn.Linear(WIDTH, 3 * WIDTH), nn.Linear(WIDTH, WIDTH)
        self.near = nn.Embedding(HEADS, 2 * FARTHEST + 1)
        self.wide, self.narrow = nn.Linear(WIDTH, 2 * WIDTH), nn.Linear(2 * WIDTH, WIDTH)
        self.dropout = nn.Dropout(DROPPED)
        nn.init.zeros_(self.near.weight)

    def look(self, states: Tensor, mask: Tensor) -> Tensor:
        """Return the next states of (sentences, rows, width); ``mask``: which see which."""
        at = torch.arange(states.shape[1])
        apart = (at[None] - at[:, None]).clamp(-FARTHEST, FARTHEST) + FARTHEST
        bias = self.near.weight[:, apart][None].masked_fill(~mask, -1e9)
        query, key, value = map(_heads, self.mix(self.norm1(states)).chunk(3, 2))
        return states + self.dropout(self.join(_attend(query, key, value, bias)))

    def think(self, states: Tensor) -> Tensor:
        """Return the states after each row has thought by itself."""
        wide = torch.relu(self.wide(self.norm2(states)))
        return states + self.dropout(self.narrow(self.dropout(wide)))

    def forward(self, states: Tensor, mask: Tensor) -> Tensor:
        """Return the next states of units."""
        return self.think(self.look(states, mask))


class DecoderLayer(Layer):
    """Let actions look at those before them and at the sentence."""

    def __init__(self) -> None:
        super().__init__()
        self.norm3 = nn.LayerNorm(WIDTH)
        self.ask, self.tell = nn.Linear(WIDTH, WIDTH), nn.Linear(WIDTH, 2 * WIDTH)
        self.answer = nn.Linear(WIDTH, WIDTH)
        self.far = nn.Embedding(HEADS, DISTANCES)
        nn.init.zeros_(self.far.weight)

    def hear(self, states: Tensor, units: Tensor, batch: ExampleBatch) -> Tensor:
        """Return the states after they have looked at the sentence."""
        told = self.far.weight[:, -1][None, :, None, None] * batch.is_told[:, None]
        bias = self.far.weight[:, _distances(batch)].transpose(0, 1) + told
        bias = bias.masked_fill(~batch.mask[:, None, None], -1e9)
        query = _heads(self.ask(self.norm3(states)))
        key, value = map(_heads, self.tell(units).chunk(2, 2))
        return states + self.dropout(self.answer(_attend(query, key, value, bias)))


class TrainableNetwork(nn.Module):
    """Score the actions that write a sentence's plan."""

    def __init__(self) -> None:
        super().__init__()
        self.words = nn.Embedding(BUCKETS, FELT)
        self.pieces = nn.EmbeddingBag(BUCKETS, FELT, mode="mean")
        self.felt = nn.Linear(FELT, WIDTH)
        self.encoder = nn.ModuleList(Layer() for _ in range(ENCODER_LAYERS))
        self.decoder = nn.ModuleList(DecoderLayer() for _ in range(DECODER_LAYERS))
        self.heard, self.norm = nn.LayerNorm(WIDTH), nn.LayerNorm(WIDTH)
        self.keys = nn.Linear(WIDTH, WIDTH, bias=False)
        self.taken = nn.Linear(WIDTH, WIDTH)
        self.tokens = nn.Embedding(len(TOKENS) + 1, WIDTH)
        self.parts = nn.Embedding(len(PARTS), WIDTH)
        self.apart = nn.Embedding(len(PARTS), DISTANCES)
        nn.init.zeros_(self.apart.weight)
        self.out = nn.Linear(WIDTH, WIDTH)
        self.scores = nn.Linear(WIDTH, len(TOKENS))
        self.point = nn.Linear(WIDTH, WIDTH, bias=False)
        self.dropout = nn.Dropout(DROPPED)
        for table, spread in (
            *((self.words, 0.1), (self.pieces, 0.1)),
            *((self.tokens, 0.3), (self.parts, 0.3)),
        ):
            nn.init.normal_(table.weight, std=spread)

    def tables(self) -> list[nn.Parameter]:
        """Return the weights of buckets."""
        return [self.words.weight, self.pieces.weight]

    def encode(self, batch: ExampleBatch) -> Tensor:
        """Return the states of (sentences, units, width)."""
        count, units = batch.mask.shape
        felt = self.felt(self.words(batch.words) + self.pieces(batch.pieces, batch.starts))
        states = torch.zeros(count * units, WIDTH).index_copy(0, batch.unit_at, felt)
        states = self.dropout(states.view(count, units, WIDTH))
        mask = batch.mask[:, None, None].expand(count, 1, units, units)
        for layer in self.encoder:
            states = layer(states, mask)
        return self.heard(states)

    def forward(self, batch: ExampleBatch) -> Tensor:
        """Return logits (sentences, actions, tokens + units); what isn't allowed has -1e9."""
        units, action = self.encode(batch), batch.written
        count, length = action.shape
        token = self.tokens(action.clamp(min=0))
        unit = self.taken(units)[torch.arange(count)[:, None], (-1 - action).clamp(min=0)]
        states = torch.where((action < 0)[..., None], unit, token) + self.parts(batch.parts)
        states = self.dropout(states)
        before = torch.ones(length, length, dtype=torch.bool).tril()[None, None]
        for layer in self.decoder:
            states = layer.think(layer.hear(layer.look(states, before), units, batch))
        out = self.dropout(torch.tanh(self.out(self.norm(states))))
        pointed = torch.bmm(self.point(out), self.keys(units).transpose(1, 2)) / WIDTH**0.5
        table = self.apart(batch.parts)
        pointed = pointed + table.gather(2, _distances(batch)) + table[..., -1:] * batch.is_told
        logits = torch.cat((self.scores(out), pointed), 2)
        return logits.masked_fill(~batch.allowed, -1e9)
