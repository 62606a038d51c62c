"""Own the network: the mean of what a sentence's features say, one hidden layer, the intents."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from planner.language.intent.features import BUCKETS

EMBEDDED = 32
HIDDEN = 64
DROPPED = 0.2


class IntentNetwork(nn.Module):
    """Score a sentence's intent, and of each unit whether it names the thing."""

    def __init__(self, intents: int) -> None:
        super().__init__()
        self.embedding = nn.EmbeddingBag(BUCKETS, EMBEDDED, mode="mean")
        self.hidden = nn.Linear(EMBEDDED, HIDDEN)
        self.output = nn.Linear(HIDDEN, intents)
        self.dropout = nn.Dropout(DROPPED)
        self.tags = nn.EmbeddingBag(BUCKETS, 1, mode="sum")
        self.tag_bias = nn.Parameter(torch.zeros(1))
        nn.init.zeros_(self.tags.weight)

    def intent(self, features: Tensor, offsets: Tensor) -> Tensor:
        """Return logits (sentences, intents) of flat feature buckets and where each begins."""
        mean = self.dropout(self.embedding(features, offsets))
        return self.output(self.dropout(torch.relu(self.hidden(mean))))

    def thing(self, features: Tensor, offsets: Tensor) -> Tensor:
        """Return a logit of each unit: it names the thing."""
        return self.tags(features, offsets).squeeze(1) + self.tag_bias
