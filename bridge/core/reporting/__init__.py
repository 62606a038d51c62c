"""Report the state of the core as the status message."""
