"""Write the fitted network as ONNX: ``python -m tools.train.export --fit DIR --model FILE``.

Refuses a file that is larger than the budget, fails the checker or says something else than the
network does. Its metadata lets a detector choose decoder, classes and size by itself.
"""

from __future__ import annotations

import argparse
import io
import json
import sys
from pathlib import Path

import onnx
import torch

from tools.train.budget import CLASSES, HEIGHT_PX, MAX_BYTES, STRIDES, WIDTH_PX
from tools.train.compare import ExportRefusal, compare
from tools.train.learner import CHECKPOINT
from tools.train.model import Net
from tools.train.shipped_graph import ShippedNet

OPSET = 17


def main(arguments: list[str] | None = None) -> int:
    """Export; return 0, or 2 when refused."""
    parser = argparse.ArgumentParser(prog="python -m tools.train.export", description=__doc__)
    parser.add_argument(
        "--fit", type=Path, required=True, help="the folder of tools.train.training"
    )
    parser.add_argument("--model", type=Path, required=True, help="the .onnx to write")
    parser.add_argument("--commit", default="", help="the commit of the code, for the metadata")
    given = parser.parse_args(arguments)
    state = torch.load(given.fit / CHECKPOINT, map_location="cpu", weights_only=True)
    net = Net()
    net.load_state_dict(state["average"])
    net.eval()
    try:
        data = export_bytes(ShippedNet(net).eval(), metadata(given.commit))
        worst = compare(net, data)
    except ExportRefusal as error:
        print(f"tools.train.export: {error}", file=sys.stderr)
        return 2
    given.model.parent.mkdir(parents=True, exist_ok=True)
    given.model.write_bytes(data)
    facts = {
        "bytes": len(data),
        "parameters": sum(p.numel() for p in net.parameters()),
        "worst_difference": worst,
        "opset": OPSET,
        "commit": given.commit,
        "step": state["step"],
    }
    (given.fit / "export.json").write_text(json.dumps(facts, indent=1) + "\n", "utf-8")
    print(f"{given.model}: {len(data)} bytes, differs from the network by at most {worst:.1e}")
    return 0


def metadata(commit: str) -> dict[str, str]:
    """Return what the file says about itself, in the words that YOLO exports use.

    Of ``channels`` they say how many there are; here it is their order.
    """
    return {
        "names": str(dict(enumerate(CLASSES))),
        "imgsz": str([HEIGHT_PX, WIDTH_PX]),
        "stride": str(max(STRIDES)),
        "task": "detect",
        "batch": "1",
        "channels": "bgr",
        "end2end": "True",
        "description": "Finds the things of a home in pictures of the simulated camera",
        "author": "Pons",
        "license": "Apache-2.0",
        "version": commit,
    }


def export_bytes(shipped: ShippedNet, facts: dict[str, str]) -> bytes:
    """Return the file's bytes.

    Raises:
        ExportRefused: it is larger than the budget.
    """
    buffer = io.BytesIO()
    torch.onnx.export(
        shipped,
        (torch.zeros(1, HEIGHT_PX, WIDTH_PX, 3, dtype=torch.uint8),),
        buffer,
        input_names=["images"],
        output_names=["output0"],
        dynamic_axes={"output0": {1: "boxes"}},
        opset_version=OPSET,
        dynamo=False,
    )
    model = onnx.load_from_string(buffer.getvalue())
    onnx.helper.set_model_props(model, facts)
    model.producer_name, model.producer_version = "pons-train", ""
    onnx.checker.check_model(model, full_check=True)
    data: bytes = model.SerializeToString()
    if not len(data) <= MAX_BYTES:
        raise ExportRefusal(f"{len(data)} bytes; at most {MAX_BYTES} are shipped")
    return data


if __name__ == "__main__":
    sys.exit(main())
