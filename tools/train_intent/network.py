"""Own the network: the mean of what a sentence's features say, one hidden layer, the intents."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from planner.language.intent.features import BUCKETS

EMBEDDED = 48
HIDDEN = 96
DROPPED = 0.25


class IntentNetwork(nn.Module):
    """Score a sentence's intents."""

    def __init__(self, intents: int) -> None:
        super().__init__()
        self.embedding = nn.EmbeddingBag(BUCKETS, EMBEDDED, mode="mean")
        self.hidden = nn.Linear(EMBEDDED, HIDDEN)
        self.output = nn.Linear(HIDDEN, intents)
        self.dropout = nn.Dropout(DROPPED)

    def intent(self, features: Tensor, offsets: Tensor) -> Tensor:
        """Return logits (sentences, intents) of flat feature buckets and where each begins."""
        mean = self.dropout(self.embedding(features, offsets))
        return self.output(self.dropout(torch.relu(self.hidden(mean))))
