"""Read a clause by templates: sentences as data, both languages side by side (ADR 0074)."""
