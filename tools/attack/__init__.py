"""Attack the product with what a hostile client, file or model may send, and count what breaks."""
