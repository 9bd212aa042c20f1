"""Command launch: both processes in real time until Ctrl-C, to watch the robot learn or drive."""

import sys
import time

from limphome_lab import command, network, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run.pair import Pair
from limphome_lab.run.processes import raise_on_signals

POLL_S = 0.2
UNTIL_STOPPED = 1_000_000  # episodes


def parse_arguments():
    parser = command.parser(
        "launch",
        "Runs simulator and controller in real time until Ctrl-C.",
        "--policy runs/default-seed1-20250131-120000",
    )
    parser.add_argument("--config", help="experiment (INI); default config/default.ini, or the run's")
    parser.add_argument("--robot", help="robot (URDF); default config/crawler.urdf, or the run's")
    parser.add_argument("--policy", metavar="RUN", help="drive with the policy of this run instead of learning")
    parser.add_argument(
        "--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="one setting; repeatable"
    )
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for train")
    return parser.parse_args()


def make_folder(args):
    """(folder of this launch, options for the controller)"""
    config, robot, options = paths.CONFIG / "default.ini", paths.CONFIG / "crawler.urdf", []
    if args.policy:
        trained = runfolder.existing(args.policy, "policy")
        config, robot, options = trained.config, trained.robot, ["--evaluate", trained.policy]
    settings = [f"learning.episodes={UNTIL_STOPPED}", "simulator.pace=real_time", *args.set]
    out = paths.RUNS / f"launch-{time.strftime('%Y%m%d-%H%M%S')}"
    return runfolder.create(out, args.config or config, args.robot or robot, settings), options


def show(episode):
    print(
        f"episode {episode.episode}: {episode.outcome} after {episode.duration_s:.1f} s, "
        f"{abs(episode.lateral_error_m):.2f} m beside the line, reward {episode.reward:.2f}",
        flush=True,
    )


def launch(folder, url, options):
    tail = runfolder.EpisodeTail(folder.episodes)
    with Pair(folder, url, options) as pair:
        spy = command.called("spy")
        print(
            f"running in {paths.shown(folder.path)}; Ctrl-C ends it\n"
            f"watch the messages from another terminal with {spy}, or {spy} --text",
            flush=True,
        )
        while not pair.finished():
            for episode in tail.read_new():
                show(episode)
            time.sleep(POLL_S)
        pair.end()


@with_exit_code
def main():
    args = parse_arguments()
    url = network.enter(args.network)
    raise_on_signals()
    folder, options = make_folder(args)
    launch(folder, url, options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
