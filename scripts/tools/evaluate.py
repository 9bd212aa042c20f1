"""scripts/evaluate: drives with the policy of a run, greedily and without learning."""

import argparse
import json
import shutil
import sys
import time

from tools import network, runfolder
from tools.pair import Pair, PairFailed
from tools.processes import Interrupted, raise_on_signals
from tools.progress import Progress
from tools.summary import summarise, table

EPISODES = 50
POLL_S = 0.05


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/evaluate",
        description="Drives with the policy of a run, greedily and without learning; leaves RUN/evaluation/.")
    parser.add_argument("run", metavar="RUN", help="run folder")
    parser.add_argument("--episodes", type=int, default=EPISODES, help=f"how many; default {EPISODES}")
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for scripts/train")
    return parser.parse_args()


def evaluation_folder(run, episodes):
    """RUN/evaluation/, made anew: it holds nothing but what an earlier evaluation left."""
    settings = [f"learning.episodes={episodes}", "simulator.pace=lockstep"]
    runfolder.resolve_settings(run.config, settings)  # refused before the earlier evaluation is removed
    out = run.path / "evaluation"
    shutil.rmtree(out, ignore_errors=True)
    return runfolder.create(out, run.config, run.robot, settings)


def evaluate(folder, policy, url, episodes):
    tail = runfolder.EpisodeTail(folder.episodes)
    with Pair(folder, url, ["--evaluate", policy]) as pair:
        progress = Progress(episodes, quiet=not sys.stderr.isatty())
        try:
            while not pair.finished():
                progress.update(tail.read_new())
                time.sleep(POLL_S)
            pair.end()
        finally:
            progress.update(tail.read_new())
            progress.close()
    return summarise(folder.read_episodes())


def main():
    args = parse_arguments()
    try:
        url = network.enter(args.network)
        raise_on_signals()
        run = runfolder.existing(args.run, "policy")
        folder = evaluation_folder(run, args.episodes)
        summary = evaluate(folder, run.policy, url, args.episodes)
    except runfolder.InputError as error:
        print(error, file=sys.stderr)
        return 2
    except network.NetworkError as error:
        print(f"network: {error}", file=sys.stderr)
        return 1
    except PairFailed as failure:
        print(failure, file=sys.stderr)
        return failure.exit_code
    except Interrupted as interrupted:
        return interrupted.exit_code
    print(json.dumps(summary, indent=2) if args.json else table(summary))
    return 0


if __name__ == "__main__":
    sys.exit(main())
