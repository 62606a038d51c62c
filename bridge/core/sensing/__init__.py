"""Take sensor messages into the state, each with its age."""
