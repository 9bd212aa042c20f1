"""Command train: trains a policy and leaves a run folder."""

import sys
from pathlib import Path

from limphome_lab import command, network, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run.manifest import Part, begin_manifest, write_manifest
from limphome_lab.run.pair import Pair, PairFailed
from limphome_lab.run.processes import Interrupted, raise_on_signals
from limphome_lab.show import diagnose
from limphome_lab.show.progress import Progress, clock


def parse_arguments():
    parser = command.parser("train", "Trains a policy and leaves a run folder.", "--seed 2 --episodes 100")
    parser.add_argument("--config", help="experiment (INI); default config/default.ini")
    parser.add_argument("--robot", help="robot (URDF); default config/crawler.urdf")
    parser.add_argument("--episodes", type=int, help="how many; short for --set learning.episodes=N")
    parser.add_argument("--seed", type=int, help="of every random number; short for --set learning.seed=N")
    parser.add_argument(
        "--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="one setting; repeatable"
    )
    parser.add_argument("--out", metavar="DIR", help="run folder to make; default runs/<config>-seed<N>-<time>")
    parser.add_argument("--resume", metavar="DIR", help="run folder to go on with, from its newest checkpoint")
    parser.add_argument(
        "--network",
        choices=("private", "host"),
        default="private",
        help="a network namespace of its own (default), or a port of its own on the host's network",
    )
    parser.add_argument("--no-figures", dest="figures", action="store_false", help="draw none; plot does it later")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    args = parser.parse_args()
    if args.resume and (args.config or args.robot or args.out or args.set or args.seed is not None):
        parser.error("--resume takes all from the run folder; only --episodes can be changed")
    return args


def new_folder(args):
    assignments = list(args.set)
    if args.seed is not None:
        assignments.append(f"learning.seed={args.seed}")
    if args.episodes is not None:
        assignments.append(f"learning.episodes={args.episodes}")
    config = Path(args.config or paths.CONFIG / "default.ini")
    folder = runfolder.create(args.out, config, args.robot or paths.CONFIG / "crawler.urdf", assignments)
    begin_manifest(folder, config.stem)
    return folder


def resumed_folder(args):
    folder = runfolder.existing(args.resume, "manifest", "episodes", "checkpoints")
    done = folder.newest_checkpoint()
    if done == 0:
        raise runfolder.InputError(f"{args.resume}: holds no checkpoint to go on from")
    if args.episodes is not None:
        settings = runfolder.resolve_settings(folder.config, [f"learning.episodes={args.episodes}"])
        if args.episodes < done:
            raise runfolder.InputError(f"--episodes {args.episodes}: {args.resume} has {done} already")
        folder.config.write_text(settings)
    return folder


def train(folder, url, progress, resume):
    """Runs the pair to its end; what it raises is why it did not get there."""
    tail = runfolder.EpisodeTail(folder.episodes)
    tail.read_new()  # of a resumed run, told before
    with Pair(folder, url, ["--resume"] if resume else []) as pair:
        pair.run(tail, progress)


@with_exit_code
def main():
    args = parse_arguments()
    url = network.enter(args.network)
    raise_on_signals()
    folder = resumed_folder(args) if args.resume else new_folder(args)
    part = Part(folder)
    print(f"training in {paths.shown(folder.path)}", file=sys.stderr)
    total = int(folder.settings()["learning"]["episodes"])
    progress = Progress(total, done=folder.newest_checkpoint() if args.resume else 0, quiet=args.quiet)
    result, code = "finished", 0
    try:
        train(folder, url, progress, bool(args.resume))
    except Interrupted as interrupted:
        result, code = "interrupted", interrupted.exit_code
        print(how_to_go_on(folder), file=sys.stderr)
    except PairFailed as failure:
        result, code = "failed", failure.exit_code
        print(failure, file=sys.stderr)
    write_manifest(folder, part.measure(result, progress.simulated_s))
    if args.figures:
        draw(folder)
    if code == 0:
        print(f"done in {clock(part.wall_time_s)}: {paths.shown(folder.path)}", file=sys.stderr)
        if trouble := diagnose.in_a_line(folder):
            print(trouble, file=sys.stderr)
    return code


def how_to_go_on(folder):
    checkpoint = folder.newest_checkpoint()
    if checkpoint == 0:
        return "interrupted before the first checkpoint: it cannot be resumed"
    return (
        f"interrupted; {command.called('train')} --resume {paths.shown(folder.path)} goes on from episode {checkpoint}"
    )


def draw(folder):
    """Draws what can be drawn; a run that ended before its first episode has nothing to show."""
    if folder.read_episodes():
        from limphome_lab.show.figures import draw_all  # matplotlib takes most of a second to load

        draw_all(folder)


if __name__ == "__main__":
    sys.exit(main())
