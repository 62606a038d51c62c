"""Own the tables of ``state.sqlite``: what each version of the schema adds to the one before."""

from __future__ import annotations

_TABLES = """
CREATE TABLE places (
    position INTEGER PRIMARY KEY, map_id TEXT NOT NULL, id TEXT NOT NULL, record TEXT NOT NULL,
    UNIQUE (map_id, id));
CREATE TABLE objects (
    position INTEGER PRIMARY KEY, map_id TEXT NOT NULL, id TEXT NOT NULL UNIQUE,
    record TEXT NOT NULL);
CREATE TABLE fence_proposals (id TEXT PRIMARY KEY, record TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE spent (
    day TEXT NOT NULL, goal TEXT NOT NULL, calls INTEGER NOT NULL, prompt_tokens INTEGER NOT NULL,
    reply_tokens INTEGER NOT NULL, seconds REAL NOT NULL, money REAL NOT NULL,
    PRIMARY KEY (day, goal)) WITHOUT ROWID;
CREATE INDEX spent_by_goal ON spent (goal);
CREATE TABLE imports (path TEXT PRIMARY KEY, fingerprint TEXT NOT NULL) WITHOUT ROWID;
"""
_MEMORY = (
    """CREATE TABLE memory (
    id INTEGER PRIMARY KEY AUTOINCREMENT, kind TEXT NOT NULL, first_s REAL NOT NULL,
    last_s REAL NOT NULL, words TEXT NOT NULL DEFAULT '', label TEXT NOT NULL DEFAULT '',
    color TEXT, map_id TEXT NOT NULL DEFAULT '', room TEXT, support TEXT, x_m REAL, y_m REAL,
    confidence REAL NOT NULL DEFAULT 1.0, sightings INTEGER NOT NULL DEFAULT 1,
    step TEXT NOT NULL DEFAULT '', said_by TEXT NOT NULL DEFAULT '',
    thing_id TEXT NOT NULL DEFAULT '')""",
    "CREATE INDEX memory_by_time ON memory (last_s)",
    "CREATE INDEX memory_by_label ON memory (kind, label, last_s)",
    "CREATE VIRTUAL TABLE memory_terms USING fts5(terms, tokenize = 'porter unicode61')",
    """CREATE TRIGGER memory_gone AFTER DELETE ON memory
    BEGIN DELETE FROM memory_terms WHERE rowid = old.id; END""",
)
_PEOPLE = (
    """CREATE TABLE people (
    print TEXT PRIMARY KEY, id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, role TEXT NOT NULL,
    since TEXT NOT NULL) WITHOUT ROWID""",
)
_SETTINGS = (
    """CREATE TABLE settings_changes (
    position INTEGER PRIMARY KEY, at TEXT NOT NULL, by TEXT NOT NULL, names TEXT NOT NULL)""",
)
SCHEMAS = (tuple(filter(str.strip, _TABLES.split(";"))), _MEMORY, _PEOPLE, _SETTINGS)
"""What each version adds to the one before; a home of an older version is brought forward."""
VERSION = len(SCHEMAS)
