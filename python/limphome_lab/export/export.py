"""Command export: what a run recorded and learned, as files of other tools."""

import importlib
import sys
from pathlib import Path

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import Ending, with_exit_code

FORMATS = {  # by a function (run folder, folder for the files) -> files; each needs packages of its own
    "mcap": ("limphome_lab.export.mcap_file", "write"),
    "parquet": ("limphome_lab.export.table", "write_parquet"),
    "csv": ("limphome_lab.export.table", "write_csv"),
    "c": ("limphome_lab.export.c_arrays", "write"),
    "rosbag2": ("limphome_lab.export.rosbag2", "write"),
}


def parse_arguments():
    parser = command.parser(
        "export",
        "What a run recorded and learned, as files of other tools: for Foxglove and PlotJuggler (mcap), tables of "
        "decisions and episodes (parquet, csv), sources for a microcontroller (c), a bag of ROS 2 (rosbag2).",
        "runs/default-seed1-20250131-120000 --format parquet",
    )
    parser.add_argument("run", metavar="RUN", help="run folder")
    parser.add_argument("--format", choices=FORMATS, default="mcap", help="default: mcap")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder for the files; default: export/ in RUN")
    return parser.parse_args()


@with_exit_code
def main():
    args = parse_arguments()
    folder = runfolder.existing(args.run, "messages")
    out = args.out or folder.path / "export"
    out.mkdir(parents=True, exist_ok=True)
    for file in writer(args.format)(folder, out):
        print(paths.shown(file))
    return 0


def writer(name):
    """The function of a format."""
    module, function = FORMATS[name]
    try:
        return getattr(importlib.import_module(module), function)
    except ModuleNotFoundError as error:
        wanted = f"--format {name} needs the Python package {error.name}: pip install 'limphome-lab[export]'"
        raise Ending(wanted) from error


if __name__ == "__main__":
    sys.exit(main())
