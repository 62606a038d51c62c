"""Read questions about before: what was seen or told, who was where, what the robot did. Pure."""

from planner.language.recall.reader import RecallReading, read_recall, read_span

__all__ = ["RecallReading", "read_recall", "read_span"]
