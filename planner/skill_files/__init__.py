"""Read, watch, check and run the owner's skills: each a routine or a function (ADR 0087)."""
