"""Ship what was fitted: bytes in and boxes out say what the network says, where PyTorch is."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import numpy as np
import pytest

torch = pytest.importorskip(
    "torch", reason="PyTorch lives in an environment of its own: tools/train/"
)

from tools.train.budget import CLASSES, FLOOR  # noqa: E402  # only where PyTorch is
from tools.train.compare import TOLERANCE, ExportRefusal, compare, difference, draw_picture  # noqa: E402
from tools.train.export import export_bytes, metadata  # noqa: E402
from tools.train.model import Net, Tensor, cells  # noqa: E402
from tools.train.shipped_graph import ShippedNet, on_strip, rows  # noqa: E402

torch.set_num_threads(1)  # two wait for each other where others work too
WHERE = torch.cat(cells())[None]
QUIET = -20.0


@pytest.fixture(scope="module")
def net() -> Net:
    """Return a network that was never fitted and yet finds things."""
    torch.manual_seed(1)
    net = Net()
    net.train()
    for head in net.heads:
        torch.nn.init.normal_(head.what.weight, std=0.5)
        torch.nn.init.constant_(head.what.bias, -14.0)
    random = np.random.default_rng(1)
    with torch.no_grad():
        for _ in range(20):  # that its units lie where those of a fitted one do
            net(torch.stack([planes(draw_picture(random)) for _ in range(2)]))
    net.eval()
    return net


def planes(picture: Any) -> Tensor:
    """Return a picture as the network is fitted on it."""
    return torch.from_numpy(picture).permute(2, 0, 1).float() / 255


def said(*cells_: tuple[int, int, float]) -> Tensor:
    """Return what all cells say: these a class by a logit, the others nothing; sides of 1 cell."""
    spoken = torch.zeros(1, len(CLASSES) + 4, WHERE.shape[2])
    spoken[:, : len(CLASSES)] = QUIET
    for cell, number, logit in cells_:
        spoken[0, number, cell] = logit
    return spoken


def test_the_first_convolution_reads_bytes_as_they_lie_in_a_picture() -> None:
    conv = Net().to4[0][0]
    picture = draw_picture(np.random.default_rng(4))
    strip = torch.from_numpy(picture[:, :, ::-1].copy()).reshape(1, 1, 240, 960).float()
    with torch.no_grad():
        true, got = conv(planes(picture)[None]), on_strip(conv)(strip)
    assert true.std() > 0.05
    assert torch.allclose(got, true, atol=1e-5)


def test_bytes_say_what_planes_of_floats_say(net: Net) -> None:
    picture = draw_picture(np.random.default_rng(3))
    strip = torch.from_numpy(picture[None, :, :, ::-1].copy())
    with torch.no_grad():
        spoken = torch.cat(net(planes(picture)[None]), 1)
        assert spoken.std(2).min() > 0.05
        assert torch.allclose(ShippedNet(net).eval().raw_rows(strip), spoken, atol=1e-3)


def test_of_a_heap_of_one_class_the_surest_stays_and_classes_never_hide_each_other() -> None:
    # Cells 0 and 1 stand side by side: a third of their boxes overlaps.
    apart = said((0, 3, 1.0), (0, 5, 0.5), (1, 3, 0.9), (4000, 5, 2.0), (4000, 3, -9.0))
    found = rows(apart, WHERE)[0]
    assert found[:, 5].tolist() == [5, 3, 3]
    # Here all three say the very same box.
    same = said((0, 3, 1.0), (1, 3, 0.9), (2, 5, 0.8))
    for cell, shift in ((1, 1.0), (2, 2.0)):
        middle = torch.tensor([shift, 0.0, -shift, 0.0])
        same[0, -4:, cell] = (torch.tensor([4.0, 4.0, 4.0, 4.0]) + middle).log()
    same[0, -4:, 0] = torch.tensor([4.0, 4.0, 4.0, 4.0]).log()
    (first, second) = rows(same, WHERE)[0].tolist()
    assert first[:4] == pytest.approx([-14, -14, 18, 18], abs=1e-3)
    assert first[4:] == pytest.approx([0.7311, 3], abs=1e-3)
    assert second[:4] == pytest.approx(first[:4], abs=1e-3)
    assert second[5] == 5


def test_what_is_hardly_sure_is_nothing() -> None:
    edge = float(np.log(FLOOR / (1 - FLOOR)))
    assert rows(said((7, 1, edge + 0.01)), WHERE).shape == (1, 1, 6)
    assert rows(said((7, 1, edge - 0.01)), WHERE).shape == (1, 0, 6)


def test_a_file_is_shipped_only_if_it_says_what_was_fitted(net: Net) -> None:
    data = export_bytes(ShippedNet(net).eval(), metadata(""))
    assert compare(net, data) <= TOLERANCE
    other = deepcopy(net)
    with torch.no_grad():
        other.to4[0][0].weight.copy_(net.to4[0][0].weight.flip(1))  # blue for red
    with pytest.raises(ExportRefusal, match="differs"):
        compare(other, data)
    silent = Net().eval()
    with pytest.raises(ExportRefusal, match="too few"):
        compare(silent, export_bytes(ShippedNet(silent).eval(), metadata("")))


def test_another_count_or_class_is_a_difference() -> None:
    one = np.array([[[0, 0, 9, 9, 0.5, 3]]], np.float32)
    other = one.copy()
    other[..., 5] = 4
    assert difference(one, one) == 0.0
    assert difference(one, other) == 1.0
    assert difference(one, one[:, :0]) == float("inf")
    assert difference(one[:, :0], one[:, :0]) == 0.0
    assert not difference(one * np.nan, one) <= 1.0
