"""What the commands have in common: what a person calls them, their help, and what is said where a name is mistaken."""

import argparse
import difflib
import tempfile
from pathlib import Path

from limphome_lab import paths


def called(name):
    """In a source tree the script of this name; where the package is installed, its entry point."""
    return f"scripts/{name}" if paths.IN_TREE else f"limphome-{name}"


class _Parser(argparse.ArgumentParser):
    def parse_args(self, args=None, namespace=None):
        """As argparse does it; a pattern that a shell has made into more run folders than are taken is told of."""
        parsed, over = self.parse_known_args(args, namespace)
        runs = [word for word in over if (Path(word) / "config.ini").is_file()]
        if runs:
            self.error(f"one RUN is taken, and {', '.join(runs)} is over: a pattern may have matched several; name one")
        if over:
            self.error(f"unrecognized arguments: {' '.join(over)}")
        return parsed


def parser(name, description, example):
    """Parser for the command `name`; `example`: words after the command that show how it is used."""
    epilog = f"example: {called(name)} {example}"
    return _Parser(prog=called(name), description=description, epilog=epilog)


def file_to_write(text):
    """Type of an argument: Path of a file written once all is measured; one that cannot be is told of now."""
    path = Path(text)
    try:
        if path.exists():
            open(path, "ab").close()
        else:
            tempfile.TemporaryFile(dir=path.parent).close()
    except OSError as error:
        raise argparse.ArgumentTypeError(f"{text or path}: {error.strerror}") from error
    return path


def did_you_mean(name, suffix):
    """ ", did you mean ...?" for the name of a file of that kind that is not there; nothing where none that comes along
    is like it."""
    own = {file.stem: file for file in sorted(paths.CONFIG.rglob(f"*{suffix}"))}
    stem = Path(name).name.removesuffix(suffix)
    like = [stem] if stem in own else [each for each in own if stem in each]
    like = like or difflib.get_close_matches(stem, own, n=2)
    return f"; did you mean {' or '.join(paths.shown(own[each]) for each in like)}?" if like else ""
