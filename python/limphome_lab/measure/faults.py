"""Command faults: injects every fault that the tests know, and tells in a table what came of each.

The rows are the tests marked `fault` (test/conftest.py): the table says what it is that the tests have shown.
"""

import json
import sys
from dataclasses import asdict, dataclass
from itertools import groupby
from pathlib import Path

from limphome_lab import command, paths
from limphome_lab.ending import Ending, with_exit_code

WIDTH = 48  # of a column for people [characters]


@dataclass
class Row:
    fault: str
    injected: str
    expected: str
    observed: str
    passed: bool
    test: str


class Collector:
    """A plugin of pytest that makes a row of each marked test."""

    def __init__(self, out):
        self.rows = []
        self.out = out

    def pytest_runtest_logreport(self, report):
        """A test has a report for each of set-up, call and tear-down: the call makes the row, or a set-up that did not
        come to it; a tear-down that fails spoils the row."""
        if not hasattr(report, "fault"):
            return
        if report.when == "call" or (report.when == "setup" and not report.passed):
            observed = report.observed if report.passed else reason(report)
            passed = report.passed and bool(observed)  # a test that observed nothing has shown nothing
            self.rows.append(Row(**report.fault, observed=observed, passed=passed, test=report.nodeid))
            print(f"{verdict(self.rows[-1]):6}  {self.rows[-1].fault}", file=self.out, flush=True)
        elif report.failed:
            self.rows[-1].passed = False
            self.rows[-1].observed = reason(report)


def reason(report):
    """Why a test did not pass: in a skipped one's own words, else the line that failed."""
    if report.skipped:
        return f"skipped: {report.longrepr[2]}"
    crash = getattr(report.longrepr, "reprcrash", None)
    return (crash.message if crash else str(report.longrepr)).partition("\n")[0]


def inject(folder, selected, out):
    """Runs the marked tests in `folder`, or those whose name holds `selected`; their rows, in order."""
    import pytest  # is there once all is set up, and --help before

    collector = Collector(out)
    options = ["-m", "fault", "-q", "--no-header", "-p", "no:terminalreporter", *(["-k", selected] if selected else [])]
    code = pytest.main([*options, str(folder)], plugins=[collector])
    if code not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
        raise Ending(f"pytest ended with {code!r}: no fault was injected, or a test could not be read")
    return collector.rows


def cut(text):
    return text if len(text) <= WIDTH else text[: WIDTH - 3] + "..."


def table(rows):
    """For people; the JSON has the whole texts."""
    lines = [("fault", "injected", "expected", "observed", "")]
    lines += [(row.fault, row.injected, row.expected, row.observed, verdict(row)) for row in rows]
    lines = [tuple(map(cut, line)) for line in lines]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in lines
    )


def markdown(rows):
    """The whole texts, under a heading for each file of tests."""
    lines = ["# Faults", "", f"What `scripts/faults --markdown` wrote: {count(rows)}.", ""]
    for file, its_rows in groupby(rows, lambda row: row.test.partition("::")[0]):
        lines += [f"## {Path(file).stem.removeprefix('test_').replace('_', ' ').capitalize()}", ""]
        lines += ["| fault | injected | expected | observed | |", "|---|---|---|---|---|"]
        for row in its_rows:
            cells = (row.fault, row.injected, row.expected, row.observed, verdict(row))
            lines.append("| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |")
        lines.append("")
    return "\n".join(lines)


def verdict(row):
    return "passed" if row.passed else "LOST"


def count(rows):
    return f"{len(rows)} faults injected, {sum(not row.passed for row in rows)} lost"


def parse_arguments():
    parser = command.parser(
        "faults", "Injects faults into link, programs and files, and tells what came of each.", "--json faults.json"
    )
    parser.add_argument(
        "--json", metavar="FILE", type=command.file_to_write, help="write the rows, with their whole texts"
    )
    parser.add_argument(
        "--markdown", metavar="FILE", type=command.file_to_write, help="write them as a page, such as docs/faults.md"
    )
    parser.add_argument("-k", dest="selected", metavar="WORDS", help="only those whose test's name holds these words")
    return parser.parse_args()


@with_exit_code
def main():
    args = parse_arguments()
    rows = inject(paths.ROOT / "test", args.selected, sys.stderr)
    print(table(rows))
    print(count(rows))
    if args.json:
        args.json.write_text(json.dumps([asdict(row) for row in rows], indent=2) + "\n")
    if args.markdown:
        args.markdown.write_text(markdown(rows))
    return 0 if all(row.passed for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
