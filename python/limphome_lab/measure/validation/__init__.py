"""Measures the simulator against closed forms, quasi-static analysis and another engine."""
