"""Hold the plain geometry and arithmetic that every wing of the core uses."""
