"""Learn a little, where PyTorch is: the budget holds, a run goes on, the export says the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip(
    "torch", reason="PyTorch lives in an environment of its own: tools/train/"
)

from tools.train.assign import assign  # noqa: E402  # only where PyTorch is
from tools.train.batches import Batch, Feeder  # noqa: E402
from tools.train.budget import MAX_GFLOPS, Schedule  # noqa: E402
from tools.train.learner import Learner  # noqa: E402
from tools.train.loss import complete  # noqa: E402
from tools.train.model import Net, cells, gflops  # noqa: E402
from tools.train.store import StoredFrame  # noqa: E402

torch.set_num_threads(1)  # two wait for each other where others work too
SCHEDULE = Schedule(epochs=20, batch=2, warm_steps=2)


@pytest.fixture
def feeder() -> Feeder:
    """Return a feeder whose batches are never asked for."""
    return Feeder([StoredFrame(b"", np.zeros((0, 6), np.float32))] * 2, SCHEDULE)


def batch() -> Batch:
    pictures = np.zeros((2, 240, 320, 3), np.float32)
    pictures[0, 60:120, 200:240] = 1.0
    targets = np.zeros((2, 2, 6), np.float32)
    targets[0] = [(3, 200, 60, 240, 120, 1), (10, 0, 0, 9, 9, -1)]
    return Batch(pictures, targets)


def test_the_budget_holds() -> None:
    assert gflops(Net()) <= MAX_GFLOPS


def test_a_run_learns_and_goes_on_where_it_stopped(feeder: Feeder, tmp_path: Path) -> None:
    torch.manual_seed(0)
    learner = Learner(feeder, SCHEDULE)
    losses = [sum(learner.learn(batch())) for _ in range(8)]
    assert losses[-1] < losses[0]
    learner.save(tmp_path)
    other = Learner(feeder, SCHEDULE)
    other.resume(tmp_path)
    assert other.step == 8
    assert other.learn(batch()) == learner.learn(batch())
    with pytest.raises(ValueError, match="another run"):
        Learner(feeder, Schedule(epochs=3, batch=2)).resume(tmp_path)


def test_the_finest_cell_answers_for_what_is_smaller_than_a_cell() -> None:
    middles, strides = cells()
    tiny = torch.tensor([[101.0, 101.0, 103.0, 104.0]])
    said = torch.cat([middles - strides, middles + strides]).T
    scores = torch.full((middles.shape[1], 14), 0.1)
    answering, wanted, owner = assign(scores, said, middles, tiny, torch.tensor([10]))
    assert answering.sum() >= 1
    assert (wanted[answering][:, 10] > 0).all()
    assert wanted[~answering].sum() == 0
    assert owner[answering].sum() == 0


def test_a_cell_answers_for_one_box_only() -> None:
    middles, strides = cells()
    boxes = torch.tensor([[96.0, 96.0, 136.0, 136.0], [100.0, 100.0, 140.0, 150.0]])
    said = torch.cat([middles - 5 * strides, middles + 5 * strides]).T
    scores = torch.full((middles.shape[1], 14), 0.5)
    answering, wanted, owner = assign(scores, said, middles, boxes, torch.tensor([0, 3]))
    assert ((wanted > 0).sum(1) == answering).all()
    for index, label in ((0, 0), (1, 3)):
        mine = answering & (owner == index)
        assert 1 <= mine.sum() <= 10
        assert wanted[mine][:, label].max() > 0.3


def test_complete_overlap_is_one_for_the_same_box_and_less_the_farther_off() -> None:
    box = torch.tensor([[10.0, 10.0, 30.0, 40.0]])
    same, near, far = (float(complete(box + off, box)) for off in (0.0, 5.0, 100.0))
    assert same == pytest.approx(1.0, abs=1e-5)
    assert near > 0 > far
