"""Score a brain's plans: suites, a mock world, matchers, laws by category, a table."""
