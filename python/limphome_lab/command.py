"""What the commands have in common: what a person calls them, and their help."""

import argparse

from limphome_lab import paths


def called(name):
    """In a source tree the script of this name; where the package is installed, its entry point."""
    return f"scripts/{name}" if paths.IN_TREE else f"limphome-{name}"


def parser(name, description, example):
    """Parser for the command `name`; `example`: words after the command that show how it is used."""
    epilog = f"example: {called(name)} {example}"
    return argparse.ArgumentParser(prog=called(name), description=description, epilog=epilog)
