"""Command evaluate: drives with the policy of a run, without learning."""

import json
import sys

from limphome_lab import command, files, network, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run.average import average_policy
from limphome_lab.run.manifest import EVALUATION, Part, begin_manifest, write_manifest
from limphome_lab.run.pair import Pair
from limphome_lab.run.processes import raise_on_signals
from limphome_lab.run.viewing import Viewing, add_argument
from limphome_lab.sealed import seal
from limphome_lab.show.progress import Progress
from limphome_lab.show.summary import summarise, table

EPISODES = 50


def parse_arguments():
    parser = command.parser(
        "evaluate",
        "Drives with the policy of a run, without learning; leaves a run folder.",
        "runs/default-seed1-20250131-120000 --set episode.goal_distance_m=10",
    )
    parser.add_argument("run", metavar="RUN", help="run folder")
    parser.add_argument("--episodes", type=int, default=EPISODES, help=f"how many; default {EPISODES}")
    parser.add_argument(
        "--selection",
        choices=("greedy", "boltzmann"),
        default="greedy",
        help="always a best action (default), or as in training, where it ended",
    )
    parser.add_argument(
        "--average",
        type=int,
        metavar="N",
        help="Q-learning: instead of the policy the mean of the networks of the last N checkpoints; left as policy.lcm",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="SECTION.KEY=VALUE",
        help="one setting other than in training, such as another failure; repeatable",
    )
    parser.add_argument("--out", metavar="DIR", help="run folder to make; default RUN/evaluation/, made anew")
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for train")
    add_argument(parser)
    return parser.parse_args()


def evaluation_folder(trained, assignments, out=None):
    """`out`, or RUN/evaluation/, which holds nothing but what an earlier evaluation left and is made anew."""
    return runfolder.create(
        trained.path / "evaluation" if out is None else out,
        trained.config,
        trained.robot,
        assignments,
        ["--evaluate", trained.policy],
        anew=out is None,
    )


def evaluate(folder, policy, url):
    episodes = int(folder.settings()["learning"]["episodes"])
    tail = runfolder.EpisodeTail(folder.episodes)
    progress = Progress(episodes, quiet=not sys.stderr.isatty())
    begin_manifest(folder, "evaluation", kind=EVALUATION)
    part = Part(folder)
    with Pair(folder, url, ["--evaluate", policy]) as pair:
        pair.run(tail, progress)
    write_manifest(folder, part.measure("finished", progress.simulated_s, pair))
    summary = summarise(folder.read_episodes())
    if folder.settings()["task"]["path"].startswith("to "):
        from limphome_lab.show import missions  # needs the message types, which --help does without

        summary |= missions.summarise(missions.missions(folder.messages))
    return summary


@with_exit_code
def main():
    args = parse_arguments()
    with Viewing(args.view) as viewing:
        run(args)
        viewing.linger()
    return 0


def run(args):
    url = network.enter(args.network)
    raise_on_signals()
    trained = runfolder.existing(args.run, "policy")
    average = None if args.average is None else seal(average_policy(trained, args.average))
    settings = [f"learning.episodes={args.episodes}", f"evaluation.selection={args.selection}"]
    folder = evaluation_folder(trained, [*settings, "simulator.pace=lockstep", *args.set], args.out)
    if average is not None:
        files.replace(folder.policy, average)
    summary = evaluate(folder, trained.policy if average is None else folder.policy, url)
    print(json.dumps(summary, indent=2) if args.json else table(summary), flush=True)


if __name__ == "__main__":
    sys.exit(main())
