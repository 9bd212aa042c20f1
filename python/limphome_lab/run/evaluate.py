"""Command evaluate: drives with the policy of a run, without learning."""

import json
import sys

from limphome_lab import command, files, network, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run import elsewhere
from limphome_lab.run.average import average_policy
from limphome_lab.run.manifest import EVALUATION, Part, begin_manifest, write_manifest
from limphome_lab.run.one_process import add_one_process, check_one_process
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
        "Drives with the policy of a run, without learning; leaves a run folder. Every episode begins from a pose of "
        "its own, drawn by seed and episode: within 0.5 m, 0.1 rad of heading and 0.2 rad of each arm joint "
        "(randomisation.position_m, .heading_rad, .joint_rad); --set one of them and only what is set is drawn, 0: "
        "always the same pose.",
        "runs/default-seed1-20250131-120000 --config config/rough.ini",
    )
    parser.add_argument("runs", metavar="RUN", nargs="+", help="run folder; of several each is evaluated")
    parser.add_argument("--episodes", type=int, default=EPISODES, help=f"how many; default {EPISODES}")
    parser.add_argument(
        "--config",
        metavar="FILE",
        help="another experiment (INI): its ground, failures, sensors and task; how the policy was learned stays",
    )
    parser.add_argument("--seed", type=int, help="of what is drawn, such as poses; default: that of the training")
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
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table; of several runs a list")
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for train")
    add_one_process(parser)
    add_argument(parser)
    args = parser.parse_args()
    check_one_process(parser, args)
    if args.out is not None and len(args.runs) > 1:
        parser.error(f"--out is for one RUN, and these are {len(args.runs)}: {', '.join(args.runs)}")
    return args


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


def evaluate(folder, policy, url, viewing):
    episodes = int(folder.settings()["learning"]["episodes"])
    tail = runfolder.EpisodeTail(folder.episodes)
    progress = Progress(episodes, quiet=not sys.stderr.isatty())
    begin_manifest(folder, "evaluation", kind=EVALUATION)
    part = Part(folder)
    with Pair(folder, url, ["--evaluate", policy], ready=viewing.wait) as pair:
        pair.run(tail, progress)
    write_manifest(folder, part.measure("finished", progress.simulated_s, pair))
    summary = summarise(folder.read_episodes())
    if folder.settings()["task"]["path"].startswith("to "):
        from limphome_lab.show import missions  # needs the message types, which --help does without

        summary |= missions.summarise(missions.missions(folder.messages))
    return summary


def evaluate_one(args, run, url, viewing):
    """The summary of one run."""
    trained = runfolder.existing(run, "policy")
    average = None if args.average is None else seal(average_policy(trained, args.average))
    chosen = elsewhere.assignments(trained, args.config, args.seed, args.set)
    elsewhere.check_fits(trained, chosen)
    settings = [f"learning.episodes={args.episodes}", f"evaluation.selection={args.selection}"]
    folder = evaluation_folder(trained, [*settings, "simulator.pace=lockstep", *chosen], args.out)
    if average is not None:
        files.replace(folder.policy, average)
    return evaluate(folder, trained.policy if average is None else folder.policy, url, viewing)


@with_exit_code
def main():
    args = parse_arguments()
    with Viewing(args.view) as viewing:
        run(args, viewing)
        viewing.linger()
    return 0


def run(args, viewing):
    url = None if args.one_process else network.enter(args.network)
    raise_on_signals()
    summaries = []
    for each in args.runs:
        summaries.append(evaluate_one(args, each, url, viewing))
        if not args.json:
            title = f"{each}\n" if len(args.runs) > 1 else ""
            print(f"{title}{table(summaries[-1])}", flush=True)
    if args.json:
        told = [{"run": each, **summary} for each, summary in zip(args.runs, summaries, strict=True)]
        print(json.dumps(told if len(told) > 1 else summaries[0], indent=2), flush=True)


if __name__ == "__main__":
    sys.exit(main())
