"""Own the pointer network in PyTorch, name for name as ``planner`` runs it in numpy."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from planner.language.semantic_parser.features import BUCKETS
from planner.language.semantic_parser.linear_plan import TOKENS
from planner.language.semantic_parser.network import HEADS
from planner.language.semantic_parser.units import MAX_UNITS

WIDTH = 128
LAYERS = 2
DROPPED = 0.1


@dataclass(frozen=True, slots=True)
class ExampleBatch:
    """Hold several examples as tensors."""

    buckets: Tensor
    """All units' buckets in one row."""
    starts: Tensor
    unit_at: Tensor
    """(units of all sentences): where each stands in (sentence, unit)."""
    mask: Tensor
    """(sentences, units): whether there is a unit."""
    written: Tensor
    """(sentences, actions): the action before; a token's number + 1, or -1 - unit."""
    wanted: Tensor
    """(sentences, actions): the index among tokens and then units; -100: none."""
    allowed: Tensor
    """(sentences, actions, tokens + units)."""


class EncoderLayer(nn.Module):
    """Let units look at each other."""

    def __init__(self) -> None:
        super().__init__()
        self.norm1, self.norm2 = nn.LayerNorm(WIDTH), nn.LayerNorm(WIDTH)
        self.mix, self.join = nn.Linear(WIDTH, 3 * WIDTH), nn.Linear(WIDTH, WIDTH)
        self.wide, self.narrow = nn.Linear(WIDTH, 2 * WIDTH), nn.Linear(2 * WIDTH, WIDTH)
        self.dropout = nn.Dropout(DROPPED)

    def forward(self, states: Tensor, mask: Tensor) -> Tensor:
        """Return the next states of (sentences, units, width)."""
        count, units, _ = states.shape
        mixed = self.mix(self.norm1(states)).view(count, units, 3, HEADS, WIDTH // HEADS)
        query, key, value = mixed.permute(2, 0, 3, 1, 4)
        joined = functional.scaled_dot_product_attention(
            query, key, value, attn_mask=mask[:, None, None, :]
        )
        joined = joined.transpose(1, 2).reshape(count, units, WIDTH)
        states = states + self.dropout(self.join(joined))
        wide = torch.relu(self.wide(self.norm2(states)))
        return states + self.dropout(self.narrow(self.dropout(wide)))


class TrainableNetwork(nn.Module):
    """Score the actions that write a sentence's plan."""

    def __init__(self) -> None:
        super().__init__()
        self.embedding = nn.EmbeddingBag(BUCKETS, WIDTH, mode="mean")
        self.positions = nn.Embedding(MAX_UNITS, WIDTH)
        self.layers = nn.ModuleList(EncoderLayer() for _ in range(LAYERS))
        self.norm = nn.LayerNorm(WIDTH)
        self.keys = nn.Linear(WIDTH, WIDTH, bias=False)
        self.taken = nn.Linear(WIDTH, WIDTH, bias=False)
        self.tokens = nn.Embedding(len(TOKENS) + 1, WIDTH)
        self.begin = nn.Linear(WIDTH, WIDTH)
        self.gates_in = nn.Linear(2 * WIDTH, 3 * WIDTH)
        self.gates_hidden = nn.Linear(WIDTH, 3 * WIDTH)
        self.look = nn.Linear(WIDTH, WIDTH, bias=False)
        self.out = nn.Linear(2 * WIDTH, WIDTH)
        self.scores = nn.Linear(WIDTH, len(TOKENS))
        self.point = nn.Linear(WIDTH, WIDTH, bias=False)
        self.dropout = nn.Dropout(DROPPED)
        nn.init.normal_(self.embedding.weight, std=0.1)
        nn.init.normal_(self.positions.weight, std=0.1)
        nn.init.normal_(self.tokens.weight, std=0.3)

    def encode(self, batch: ExampleBatch) -> Tensor:
        """Return the states of (sentences, units, width)."""
        count, units = batch.mask.shape
        states = self.positions.weight[:units].expand(count, -1, -1).reshape(-1, WIDTH)
        felt = self.embedding(batch.buckets, batch.starts)
        states = states.index_add(0, batch.unit_at, felt).view(count, units, WIDTH)
        states = self.dropout(states)
        for layer in self.layers:
            states = layer(states, batch.mask)
        return self.norm(states)

    def forward(self, batch: ExampleBatch) -> Tensor:
        """Return logits (sentences, actions, tokens + units); what isn't allowed has -1e9."""
        states = self.encode(batch)
        mask = batch.mask[:, :, None].float()
        hidden = torch.tanh(self.begin((states * mask).sum(1) / mask.sum(1)))
        context = torch.zeros_like(hidden)
        taken, rows = self.taken(states), torch.arange(len(states))
        hiddens, contexts = [], []
        for number in range(batch.written.shape[1]):
            action = batch.written[:, number]
            token = self.tokens(action.clamp(min=0))
            unit = taken[rows, (-1 - action).clamp(min=0)]
            written = self.dropout(torch.where((action < 0)[:, None], unit, token))
            gates_in = self.gates_in(torch.cat((written, context), 1)).split((2 * WIDTH, WIDTH), 1)
            gates = self.gates_hidden(hidden).split((2 * WIDTH, WIDTH), 1)
            reset, update = torch.sigmoid(gates_in[0] + gates[0]).chunk(2, 1)
            fresh = torch.tanh(gates_in[1] + reset * gates[1])
            hidden = (1.0 - update) * fresh + update * hidden
            looked = torch.bmm(states, self.look(hidden)[:, :, None])[:, :, 0]
            weights = looked.masked_fill(~batch.mask, -1e9).softmax(1)
            context = torch.bmm(weights[:, None], states)[:, 0]
            hiddens.append(hidden)
            contexts.append(context)
        joined = torch.cat((torch.stack(hiddens, 1), torch.stack(contexts, 1)), 2)
        out = self.dropout(torch.tanh(self.out(self.dropout(joined))))
        units = torch.bmm(self.point(out), self.keys(states).transpose(1, 2)) / WIDTH**0.5
        logits = torch.cat((self.scores(out), units), 2)
        return logits.masked_fill(~batch.allowed, -1e9)
