"""Read what a sentence changes about the newest order; ``reader`` knows the site's names."""
