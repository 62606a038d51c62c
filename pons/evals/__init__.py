"""Score what a brain plans: suites, a mock world, matchers, laws by category, a table."""
