"""How a command ends where it cannot do what it was asked to."""

import functools
import sys


class Ending(Exception):
    """Ends the command; its text, where there is one, tells the user why."""

    exit_code = 1


def with_exit_code(main):
    """Decorates a `main` that returns an exit code: it then also returns that of an Ending, having told its text."""

    @functools.wraps(main)
    def main_with_exit_code():
        try:
            return main()
        except Ending as ending:
            if str(ending):
                print(ending, file=sys.stderr)
            return ending.exit_code

    return main_with_exit_code
