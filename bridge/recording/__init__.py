"""Record every tick so that it can be replayed, rotate recordings on disk, and read them.

The loop's side is ``recorder``. The writing process (``python -m bridge.recording``) stays small:
it imports neither the bridge's core nor pydantic, and therefore this file imports nothing.
"""
