"""Makes the package limphome_lab and the generated messages importable, here and in what the tests start; and lets a
test stand in the table of faults (scripts/faults):

    @pytest.mark.fault("what goes wrong", injected="how", expected="what is right")
    def test_of_it(observe):
        ...
        observe("what was observed, with its figures")

A test with parameters is a row for each of them.
"""

import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
PACKAGES = [str(ROOT / "python"), str(BUILD / "python")]
sys.path[:0] = PACKAGES
os.environ["PYTHONPATH"] = os.pathsep.join(PACKAGES)

OBSERVED = pytest.StashKey[list]()


@pytest.fixture(scope="session", autouse=True)
def own_registry(tmp_path_factory):
    """Pairs that run here are not found from elsewhere, nor others from here."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_RUNTIME_DIR", str(tmp_path_factory.mktemp("runtime")))
        yield


def pytest_configure(config):
    config.addinivalue_line("markers", "fault(fault, *, injected, expected): the test is a row of the table of faults")


@pytest.fixture
def observe(request):
    """Notes what was observed; of several texts the row has all."""
    request.node.stash[OBSERVED] = []
    return request.node.stash[OBSERVED].append


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item):
    """Gives the report of a marked test what limphome_lab.measure.faults makes a row of."""
    report = yield
    if mark := item.get_closest_marker("fault"):
        parameters = f" [{item.callspec.id}]" if hasattr(item, "callspec") else ""
        report.fault = {"fault": mark.args[0] + parameters, **mark.kwargs}
        report.observed = "; ".join(item.stash.get(OBSERVED, []))
    return report
