"""Remember what was seen and what people told, with ages; tell it, forget it. Moves nothing.

One table holds both (ADR 0059). Only a person's own words and the detector's figures come in: what
a model wrote, or read in a picture, never does.
"""

from planner.memory.fact_check import MAX_FACT, FactRefusal, clean_fact
from planner.memory.index_terms import index_text, match_query
from planner.memory.pictures import MEDIA_TYPES, PictureStore
from planner.memory.recollection import Recollection
from planner.memory.records import (
    FACT,
    KINDS,
    PERSON,
    THING,
    KeptPicture,
    Memo,
    MemoryLimits,
    MemoryQuery,
    ObjectSighting,
)
from planner.memory.sighting_recorder import SightingRecorder
from planner.memory.store import MemoryStore

__all__ = [
    "FACT",
    "KINDS",
    "MAX_FACT",
    "MEDIA_TYPES",
    "PERSON",
    "THING",
    "FactRefusal",
    "KeptPicture",
    "Memo",
    "MemoryLimits",
    "MemoryQuery",
    "MemoryStore",
    "ObjectSighting",
    "PictureStore",
    "Recollection",
    "SightingRecorder",
    "clean_fact",
    "index_text",
    "match_query",
]
