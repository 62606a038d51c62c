"""Think: what a brain is, and where the built-in ones are."""
