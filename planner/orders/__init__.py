"""Keep standing orders: rules of when, a pure scheduler, its store, its shell and its telling."""
