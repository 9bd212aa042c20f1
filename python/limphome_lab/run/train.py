"""Command train: trains a policy and leaves a run folder."""

import sys
from pathlib import Path

from limphome_lab import command, files, network, paths, runfolder
from limphome_lab.ending import Ending, told, with_exit_code
from limphome_lab.run.manifest import (
    EVALUATION,
    Part,
    begin_manifest,
    read_manifest,
    recording_as_it_is,
    write_manifest,
)
from limphome_lab.run.one_process import add_one_process, check_one_process
from limphome_lab.run.outlook import outlook
from limphome_lab.run.pair import Pair, SupervisedPair
from limphome_lab.run.processes import Interrupted, raise_on_signals
from limphome_lab.run.viewing import Viewing, add_argument
from limphome_lab.show import diagnose
from limphome_lab.show.progress import Progress, clock

LARGE_RECORDING = 100_000_000  # [bytes]; its size is told


def parse_arguments():
    parser = command.parser("train", "Trains a policy and leaves a run folder.", "--seed 2 --episodes 100")
    parser.add_argument("--config", help="experiment (INI); default config/default.ini")
    parser.add_argument("--robot", help="robot (URDF); default config/crawler.urdf")
    parser.add_argument("--packages", metavar="DIR[:DIR]", help="where package:// of the robot's meshes is looked for")
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
    add_one_process(parser)
    parser.add_argument(
        "--supervise", action="store_true", help="start simulator or controller again when it dies, and go on"
    )
    parser.add_argument("--no-figures", dest="figures", action="store_false", help="draw none; plot does it later")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    add_argument(parser)
    args = parser.parse_args()
    check_one_process(parser, args)
    if args.resume is not None and (
        args.config or args.robot or args.packages or args.out or args.set or args.seed is not None
    ):
        parser.error("--resume takes all from the run folder; only --episodes can be changed")
    return args


def new_folder(args):
    assignments = list(args.set)
    if args.seed is not None:
        assignments.append(f"learning.seed={args.seed}")
    if args.episodes is not None:
        assignments.append(f"learning.episodes={args.episodes}")
    config = Path(args.config or paths.CONFIG / "default.ini")
    robot = args.robot or paths.CONFIG / "crawler.urdf"
    folder = runfolder.create(args.out, config, robot, assignments, packages=args.packages)
    begin_manifest(folder, config.stem)
    return folder


def resumed_folder(args):
    """(folder, episode after which it is gone on with)"""
    folder = runfolder.existing(args.resume, "manifest")
    folder.take()
    if read_manifest(folder)["kind"] == EVALUATION:
        raise runfolder.InputError(f"{args.resume}: is an evaluation, not a training that could be gone on with")
    settings = [] if args.episodes is None else [f"learning.episodes={args.episodes}"]
    done = resumes_after(folder, settings)
    if args.episodes is not None:
        if args.episodes < done:
            raise runfolder.InputError(f"--episodes {args.episodes}: {args.resume} has {done} already")
        files.replace(folder.config, runfolder.resolve_settings(folder.config, settings))
    return folder, done


def resumes_after(folder, settings=()):
    """Episode after which the controller would go on; 0: it would begin anew."""
    options = runfolder.setting_options(folder.config, settings)
    answer = runfolder.ask(
        "controller",
        *options,
        "--robot",
        folder.robot,
        "--out",
        folder.path,
        "--resume",
        "--check",
    )
    return int(answer.split()[-1])


def train(pair, folder, progress):
    """Runs the pair to its end; what it raises is why it did not get there."""
    tail = runfolder.EpisodeTail(folder.episodes)
    tail.read_new()  # of a resumed run, told before
    with pair:
        pair.run(tail, progress)


@with_exit_code
def main():
    args = parse_arguments()
    with Viewing(args.view) as viewing:
        code = run(args, viewing)
        if code == 0:
            viewing.linger()
        return code


def run(args, viewing):
    url = None if args.one_process else network.enter(args.network)
    raise_on_signals()
    folder, done = resumed_folder(args) if args.resume is not None else (new_folder(args), 0)
    part = Part(folder)
    print(f"training in {paths.shown(folder.path)}", file=sys.stderr)
    progress = Progress(int(folder.settings()["learning"]["episodes"]), done, quiet=args.quiet)
    options = ["--resume"] if args.resume is not None else []
    pair = (SupervisedPair if args.supervise else Pair)(folder, url, options, ready=viewing.wait)
    result, code = "finished", 0
    try:
        train(pair, folder, progress)
    except Ending as ending:
        result, code = "interrupted" if isinstance(ending, Interrupted) else "failed", ending.exit_code
        print(ending if str(ending) else how_to_go_on(folder), file=sys.stderr)
    except OSError as error:
        result, code = "failed", 1
        print(told(error), file=sys.stderr)
    tell_end(args, folder, part.measure(result, progress.simulated_s, pair))
    if code == 0:
        print(f"done in {clock(part.wall_time_s)}: {paths.shown(folder.path)}", file=sys.stderr)
        if trouble := diagnose.in_a_line(folder):
            print(trouble, file=sys.stderr)
        if not args.quiet:
            print(*outlook(folder), sep="\n", file=sys.stderr)
    return code


def tell_end(args, folder, part):
    """Manifest and figures, also of a run that did not get to its end."""
    write_manifest(folder, part)
    recording = recording_as_it_is(folder.messages) or {"bytes": 0}
    if recording["bytes"] >= LARGE_RECORDING:
        thinned = "; its middle was thinned (recording.limit_mb)" if recording.get("thinned") else ""
        print(f"{paths.shown(folder.messages)} has {recording['bytes'] / 1e6:.0f} MB{thinned}", file=sys.stderr)
    if args.figures:
        try:
            draw(folder)
        except Ending as ending:  # what was cut off cannot be drawn before it is gone on with
            if part["result"] == "finished":
                raise
            print(ending, file=sys.stderr)


def how_to_go_on(folder):
    again = f"{command.called('train')} --resume {paths.shown(folder.path)}"
    done = resumes_after(folder)
    return f"interrupted; {again} " + (
        f"goes on from episode {done}" if done else "begins anew: no checkpoint was reached"
    )


def draw(folder):
    """Draws what can be drawn; a run that ended before its first episode has nothing to show."""
    if folder.read_episodes():
        from limphome_lab.show.figures import draw_all  # matplotlib takes most of a second to load

        draw_all(folder)


if __name__ == "__main__":
    sys.exit(main())
