"""What the mutation test changes."""

from limphome_lab.measure import mutate


def original(mutant):
    return (mutate.LIBRARY / mutant.file).read_text().splitlines()[mutant.number]


def test_every_mutant_changes_code_of_sources_and_headers():
    everything = list(mutate.mutants())
    files = {mutant.file for mutant in everything}
    assert {"controller.c", "learning/network.c", "base/elementary.h", "base/exponential.h", "base/lanes.h"} <= files
    assert len(set(everything)) == len(everything) > 500
    for mutant in everything:
        assert mutant.line != original(mutant)
        assert mutant.line[: mutant.column] == original(mutant)[: mutant.column]


def test_comments_and_preprocessor_lines_stay():
    for mutant in mutate.mutants():
        line = original(mutant)
        assert not line.startswith("#")
        assert not line.lstrip().startswith(("/*", "* "))
        assert "/*" not in line[: mutant.column] or "*/" in line[: mutant.column]
