"""The simulator against theory and other engines, speed against baselines, the tests against mutants."""
