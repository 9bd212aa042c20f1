"""How a script ends where it cannot do what it was asked to."""

import sys


class Ending(Exception):
    """Ends the script; its text, where there is one, tells the user why."""

    exit_code = 1


def run_script(main):
    """Calls `main`, which returns an exit code, and ends the process with it or with that of an Ending."""
    try:
        code = main()
    except Ending as ending:
        if str(ending):
            print(ending, file=sys.stderr)
        code = ending.exit_code
    sys.exit(code)
