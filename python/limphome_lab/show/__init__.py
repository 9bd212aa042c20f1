"""Figures, progress and the messages of a run."""
