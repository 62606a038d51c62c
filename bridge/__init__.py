"""Dispose: decide, every 10 ms, the one wheel command that leaves. Imports wire only, no numpy."""
