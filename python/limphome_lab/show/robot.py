"""Command robot: checks a robot file, tells what both programs understand of it and draws it; or writes one to begin
with."""

import json
import subprocess
import sys
from pathlib import Path

from limphome_lab import command, describe, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.show import template


def parse_arguments():
    parser = command.parser(
        "robot", "Checks a robot file, tells what both programs understand of it, and draws it.", "config/two_arm.urdf"
    )
    parser.add_argument("file", metavar="FILE", nargs="?", help="robot: URDF with a <limphome> element")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.add_argument(
        "--picture", metavar="PNG", help="where it is drawn; default: beside FILE, but nowhere with --json"
    )
    parser.add_argument("--packages", metavar="DIR[:DIR]", help="where package:// is looked for, before above FILE")
    template.add_arguments(parser)
    args = parser.parse_args()
    if args.template == (args.file is not None):
        parser.error("give a robot file, or --template")
    if template.given(args) and not args.template:
        parser.error("dimensions are for --template")
    return args


def explain(file, args):
    """Tells and draws what is understood of `file`."""
    # with numpy and matplotlib, which are there once all is set up, and --help before
    from limphome_lab import robot
    from limphome_lab.show.figures import robot as figure
    from limphome_lab.show.figures import style

    if not args.json:
        command_line = [paths.program("describe"), *describe.options(args.packages), file]
        code = subprocess.run(command_line, check=False).returncode
        if code != 0:
            return code
    code, told = describe.ask(file, args.packages)
    if args.json:
        print(json.dumps(told, indent=2))
    if code == 0 and (args.picture or not args.json):
        picture = args.picture or Path(file).with_suffix(".png")
        style.save(figure.draw(robot.Robot(told)), picture)
        print(f"drawn in {paths.shown(picture)}", file=sys.stderr)
    return code


@with_exit_code
def main():
    args = parse_arguments()
    if args.template:
        print(template.text(args), end="")
        return 0
    return explain(runfolder.find_robot(args.file), args)


if __name__ == "__main__":
    sys.exit(main())
