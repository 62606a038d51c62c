"""Change one thing at a time in bridge/core and see whether a test notices (docs/adr/0019)."""
