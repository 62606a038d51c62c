"""Make the intent model: sentences from phrases of our own, a small network, an ONNX file."""
