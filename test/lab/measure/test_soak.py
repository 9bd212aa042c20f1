"""What a soak says of its samples."""

import pytest

from limphome_lab.measure import soak


def samples(memory, log=lambda _: 1.0, count=100):
    return [{"log_mb": log(i), "controller.memory_kb": memory(i), "controller.descriptors": 8} for i in range(count)]


def test_what_settles_is_sound():
    assert soak.grown(samples(lambda i: 4000 + 100 * min(i, 15))) == []


def test_a_leak_is_told():
    assert "memory_kb grows" in soak.grown(samples(lambda i: 4000 + 100 * i))[0]


def test_one_descriptor_more_is_told():
    leaking = samples(lambda _: 4000)
    leaking[-1]["controller.descriptors"] += 1
    assert "descriptors grows: 8 in the first half, 9 in the second" in soak.grown(leaking)[0]


def test_a_recording_beyond_its_limit_is_told():
    assert "recording takes 99 MB" in soak.grown(samples(lambda _: 4000, lambda i: float(i)))[0]


def test_few_samples_say_nothing():
    assert "too short" in soak.grown(samples(lambda _: 4000, count=5))[0]


def test_quantiles_are_upper_edges_of_bins():
    histogram = soak.Histogram()
    histogram.add([i * 1e-6 + 0.5e-6 for i in range(1000)])
    assert histogram.quantile(0.5) == pytest.approx(500e-6)
    assert histogram.quantile(0.99) == pytest.approx(990e-6)
    assert histogram.worst == pytest.approx(999.5e-6)


def test_every_latency_stands_in_the_coarse_histogram():
    histogram = soak.Histogram()
    histogram.add([5e-6, 30e-6, 30e-6, 0.7, 3.0])
    numbers = dict(histogram.coarse())
    assert numbers[20] == 1 and numbers[50] == 2 and numbers[None] == 2
    assert sum(numbers.values()) == 5
