"""Command validate: measures the simulator against closed forms, quasi-static analysis and MuJoCo."""

import json
import sys

from limphome_lab import command
from limphome_lab.ending import with_exit_code


def parse_arguments():
    parser = command.parser(
        "validate",
        "Measures the simulator against closed forms, quasi-static analysis and MuJoCo; exit 0 only if everything lies "
        "within its tolerance.",
        "--quick --json validation.json",
    )
    parser.add_argument("--quick", action="store_true", help="cases only: no MuJoCo, no convergence")
    parser.add_argument("--json", metavar="FILE", type=command.file_to_write, help="write all figures")
    parser.add_argument("--report", metavar="FILE", type=command.file_to_write, help="write a page of Markdown")
    args = parser.parse_args()
    if args.quick and args.report:
        parser.error("a report needs more than --quick measures")
    return args


def compare_engines():
    """None where MuJoCo is not installed."""
    try:
        from limphome_lab.measure.validation import engines
    except ImportError as error:
        print(f"comparison with MuJoCo skipped: {error}", file=sys.stderr)
        return None
    return {
        "comparison": [row.as_dict() for row in engines.compare()],
        "by_speed": engines.skid_by_speed(),
        "speeds": list(engines.SPEEDS),
    }


@with_exit_code
def main():
    args = parse_arguments()
    from limphome_lab.measure.validation import cases, convergence, report  # NumPy is there once all is set up

    quantities = cases.measure(progress=lambda name: print(f"measuring: {name}", file=sys.stderr))
    result = {"quantities": [quantity.as_dict() for quantity in quantities]}
    print(report.text(report.quantities(result["quantities"])))
    if not args.quick:
        result["convergence"] = convergence.measure()
        result["mujoco"] = compare_engines()
        for table in report.further_tables(result):
            print(f"\n{report.text(table)}")
    if args.json:
        args.json.write_text(json.dumps(result, indent=2) + "\n")
    if args.report:
        args.report.write_text(report.page(result))
    failed = [row for row in result["quantities"] if not row["passed"]]
    passed = len(quantities) - len(failed)
    print(f"\n{passed} of {len(quantities)} quantities within their tolerance")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
