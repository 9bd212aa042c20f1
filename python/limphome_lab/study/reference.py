"""Upper reference of a study: a run folder made by limphome-shooting, which plans inside the simulator.

Takes the options of train that a study uses. The folder has no policy and no messages.
"""

import argparse
import sys
import time

from limphome_lab import paths, runfolder
from limphome_lab.ending import Ending, with_exit_code
from limphome_lab.run.manifest import Part, begin_manifest, write_manifest
from limphome_lab.run.processes import Child, raise_on_signals

PROGRAM = "shooting"
POLL_S = 0.2


def drive(folder):
    """Lets the program write episodes.csv; ends it, whatever happened."""
    command = [paths.program(PROGRAM), "--config", folder.config, "--robot", folder.robot]
    child = Child(PROGRAM, command, folder.episodes)
    try:
        while child.exit_code() is None:
            time.sleep(POLL_S)
    finally:
        child.stop()
    if child.exit_code() != 0:
        raise Ending(child.log_tail())


@with_exit_code
def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--config", required=True)
    parser.add_argument("--robot", required=True)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--out", required=True)
    args = parser.parse_args()
    raise_on_signals()
    folder = runfolder.create(args.out, args.config, args.robot, args.set)
    begin_manifest(folder, PROGRAM, [PROGRAM])
    part = Part(folder)
    drive(folder)
    simulated_s = sum(episode.duration_s for episode in folder.read_episodes())
    write_manifest(folder, part.measure("finished", simulated_s))
    return 0


if __name__ == "__main__":
    sys.exit(main())
