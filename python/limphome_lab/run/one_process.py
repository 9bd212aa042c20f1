"""--one-process: simulator and controller in one program and on no network, for runs that nobody watches."""


def add_one_process(parser):
    parser.add_argument(
        "--one-process",
        action="store_true",
        help="simulator and controller as one program: the same files sooner, but neither spy nor view can watch",
    )


def check_one_process(parser, args):
    """Refuses what it does not go with."""
    if args.one_process and args.view:
        parser.error("--view needs messages on a network, and with --one-process there are none")
    if args.one_process and args.network == "host":
        parser.error("--network host: with --one-process there is no network")
