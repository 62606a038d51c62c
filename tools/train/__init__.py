"""Train the detector that is shipped: homes drawn by seed, frames, a small network, its score.

A workshop, not part of a running Pons: nothing but the benches and tests imports it. What draws
(`homes`, `frames`) runs in the project's own environment; what learns (`fit`, `export`) runs in
one of its own, which alone holds PyTorch (tools/train/README.md).
"""
