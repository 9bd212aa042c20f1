"""Command launch: both processes in real time until Ctrl-C, to watch the robot learn or drive once it is armed."""

import shlex
import sys
import time

from limphome_lab import command, network, paths, runfolder
from limphome_lab.ending import InputError, with_exit_code
from limphome_lab.run.pair import Pair
from limphome_lab.run.processes import raise_on_signals
from limphome_lab.run.viewing import Viewing, add_argument

POLL_S = 0.1
UNTIL_STOPPED = 1_000_000  # episodes


def parse_arguments():
    parser = command.parser(
        "launch",
        "Runs simulator and controller in real time until Ctrl-C. The robot moves once it is armed: space or enter "
        "arms and disarms it. h takes it by hand: while 1, 2, ... 8 are held down the first, second, ... actuator goes "
        "ahead, with q, w, ... i back; l hands it to the learner, which limps home from there.",
        "--policy runs/default-seed1-20250131-120000",
    )
    parser.add_argument("--config", help="experiment (INI); default config/default.ini, or the run's")
    parser.add_argument("--robot", help="robot (URDF); default config/crawler.urdf, or the run's")
    parser.add_argument("--packages", metavar="DIR[:DIR]", help="where package:// of the robot's meshes is looked for")
    parser.add_argument("--policy", metavar="RUN", help="drive with the policy of this run instead of learning")
    parser.add_argument(
        "--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="one setting; repeatable"
    )
    parser.add_argument(
        "--driver",
        metavar="COMMAND",
        help="the program that drives a real robot, in place of the simulator and given the same options beside its "
        "own words (docs/real_robot.md)",
    )
    parser.add_argument("--arm", action="store_true", help="arm the robot right away, without a key")
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for train")
    add_argument(parser)
    return parser.parse_args()


def make_folder(args):
    """(folder of this launch, options for the controller)"""
    config, robot, options = paths.CONFIG / "default.ini", paths.CONFIG / "crawler.urdf", []
    if args.policy:
        trained = runfolder.existing(args.policy, "policy")
        config, robot, options = trained.config, trained.robot, ["--evaluate", trained.policy]
    settings = [f"learning.episodes={UNTIL_STOPPED}", "simulator.pace=real_time", "link.give_up_s=0", *args.set]
    out = paths.new_run("launch")
    robot = args.robot or robot
    folder = runfolder.create(out, args.config or config, robot, settings, real_time=True, packages=args.packages)
    return folder, options


def show(episode):
    print(
        f"episode {episode.episode}: {episode.outcome} after {episode.duration_s:.1f} s, "
        f"{abs(episode.lateral_error_m):.2f} m beside the line, reward {episode.reward:.2f}",
        flush=True,
    )


def how_to_drive(keys, arm, by_hand):
    if keys.terminal is not None:
        return f"space or enter arms the robot, and disarms it\n{by_hand}"
    return (
        "arming, as --arm says" if arm else "the robot stays disarmed: there is no terminal to arm it from, nor --arm"
    )


def tell(text):
    print(text, file=sys.stderr, flush=True)


def launch(folder, url, options, arm, viewing, driver=None):
    from limphome_lab import robot  # these are there once all is set up, and --help before
    from limphome_lab.run.arming import ARMS, Keys, Operator
    from limphome_lab.run.hand import Hand, HandKeys, words

    tail = runfolder.EpisodeTail(folder.episodes)
    by_hand = words(robot.read(folder.robot).actuators)
    with (
        Pair(folder, url, options, driver, viewing.wait) as pair,
        Keys() as keys,
        Operator(url, tell, arm) as operator,
        Hand(url, tell) as hand,
    ):
        hand_keys = HandKeys(hand)
        spy = command.called("spy")
        print(
            f"running in {paths.shown(folder.path)}; Ctrl-C ends it\n"
            f"watch the messages from another terminal with {spy}, or {spy} --text",
            flush=True,
        )
        tell(how_to_drive(keys, arm, by_hand))
        while not pair.finished():
            for key in keys.typed():
                if key in ARMS:
                    operator.toggle()
                    hand_keys.stop()
                else:
                    hand_keys.press(key, time.monotonic())
            operator.answer()
            hand_keys.look(time.monotonic())
            for episode in tail.read_new():
                show(episode)
            time.sleep(POLL_S)
        pair.end()


@with_exit_code
def main():
    args = parse_arguments()
    driver = None if args.driver is None else shlex.split(args.driver)
    if driver == []:
        raise InputError("--driver: names no program")
    with Viewing(args.view) as viewing:
        url = network.enter(args.network)
        raise_on_signals()
        folder, options = make_folder(args)
        launch(folder, url, options, args.arm, viewing, driver)
    return 0


if __name__ == "__main__":
    sys.exit(main())
