"""What scripts/bench reports, and that NumPy's decision is the one the others take."""

import numpy as np
import pytest

from limphome_lab.measure import bench, bench_numpy


def test_ratio_above_one_is_better():
    faster = bench.lower_is_better("decision", 2e-6, "s", 3e-5, "")
    assert faster.ratio == pytest.approx(15)
    assert set(faster.as_dict()) == {"name", "value", "unit", "baseline", "ratio"}


def test_table_names_every_figure():
    figures = [bench.Figure("a", 1.0, "s", 2.0, 2.0, "one"), bench.Figure("b", 3.0, "1/s", 1.0, 3.0, "two")]
    lines = bench.table(figures).splitlines()
    assert [line.split()[0] for line in lines] == ["name", "a", "b"]


def test_numpy_evaluates_every_action_as_the_plain_loop():
    learner = bench_numpy.Learner()
    states = learner.random.uniform(0, 1, bench_numpy.STATES)
    learner.inputs[:, : bench_numpy.STATES] = states
    q = learner.activations(learner.inputs)[0] @ learner.weight
    for x, value in zip(learner.inputs, q, strict=True):
        expected = sum(
            w * np.exp(-((x - mu) ** 2).sum() / sigma**2)
            for w, mu, sigma in zip(learner.weight, learner.centre, learner.width, strict=True)
        )
        assert value == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_numpy_learns_towards_the_target():
    learner = bench_numpy.Learner()
    before = learner.activations(learner.last)[0] @ learner.weight
    learner.learn(before + 1)
    assert learner.activations(learner.last)[0] @ learner.weight > before
