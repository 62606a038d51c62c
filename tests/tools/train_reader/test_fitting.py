"""Learn a little, where PyTorch is: numpy scores alike, and the same seed gives the same file."""

from __future__ import annotations

from itertools import islice
from pathlib import Path

import pytest

torch = pytest.importorskip(
    "torch", reason="PyTorch lives in an environment of its own: tools/train_reader/"
)

from planner.language.semantic_parser.features import sentence_features  # noqa: E402
from planner.language.semantic_parser.linear_plan import (  # noqa: E402
    TOKEN_NUMBERS,
    TOKENS,
    GrammarWalk,
)
from planner.language.semantic_parser.model_file import read_model, write_model  # noqa: E402
from tools.train_reader.earlier_sentences import earlier_examples  # noqa: E402
from tools.train_reader.fitting import fit, make_batch  # noqa: E402


def test_the_fitted_network_scores_alike_in_numpy_and_is_fitted_alike_again(tmp_path: Path) -> None:
    torch.set_num_threads(1)
    examples = list(islice(earlier_examples(), 60))
    networks = [fit(examples, 2, 1, lambda _: None) for _ in range(2)]
    for name, network in zip(("one", "other"), networks, strict=True):
        weights = {name: each.numpy() for name, each in network.state_dict().items()}
        write_model(weights, tmp_path / name)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()
    example = max(examples, key=lambda each: len(each.actions))
    features = sentence_features(example.said.units)
    with torch.no_grad():
        logits = networks[0](make_batch([example], [features]))[0].numpy()
    reader = read_model(tmp_path / "one")
    encoded, memory = reader.encode(features), reader.begin(len(example.said.units))
    written, walk = reader.token(0), GrammarWalk()
    for action, (tokens, units), wanted in zip(
        example.actions, example.allowed, logits, strict=True
    ):
        scores, unit_scores = reader.step(encoded, memory, [written], [walk.part_number])
        assert scores[0, tokens] == pytest.approx(wanted[tokens], abs=0.15)
        pointed = [len(TOKENS) + unit for unit in units]
        assert unit_scores[0, units] == pytest.approx(wanted[pointed], abs=0.15)
        expected = walk.next_actions()
        walk.take(action)
        if isinstance(action, int):
            memory.point(0, action, expected.first if expected.is_last else action)
            written = encoded.taken[action]
        else:
            written = reader.token(TOKEN_NUMBERS[action] + 1)
    assert walk.is_done
