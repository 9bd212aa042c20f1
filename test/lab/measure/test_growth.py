"""scripts/growth: whoever ends it ends the study that it measures, too."""

import signal
import subprocess
import sys
import time

GROWTH = """
import sys
from limphome_lab.measure import growth
growth.network.enter = lambda how: None
growth.MEASURED = {"study": lambda: growth.study_seconds(1, 1)}
sys.executable, sys.argv = sys.argv[1], ["growth", sys.argv[2]]
sys.exit(growth.main())
"""
STUDY = """#!/bin/sh
trap 'kill $!; touch "{0}/in_order"; exit 143' TERM
sleep 30 &
touch "{0}/begun"
wait
"""


def test_study_is_ended_in_order(tmp_path):
    study = tmp_path / "study"
    study.write_text(STUDY.format(tmp_path))
    study.chmod(0o755)
    growth = subprocess.Popen([sys.executable, "-c", GROWTH, study, tmp_path / "out"])
    deadline = time.monotonic() + 20
    while not (tmp_path / "begun").exists():
        assert growth.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)
    growth.send_signal(signal.SIGTERM)
    assert growth.wait(20) == 128 + signal.SIGTERM
    assert (tmp_path / "in_order").exists()
