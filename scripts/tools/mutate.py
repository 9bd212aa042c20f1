"""Mutation test of liblimphome: changes one operator or number at a time and runs the Check tests."""

import argparse
import pathlib
import random
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHANGES = [
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "),
    (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "),
    (r" == ", " != "), (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "),
    (r"\+= ", "-= "), (r"\b0\.5f", "0.6f"), (r"\b1\.0f", "1.1f"), (r"\b0\.0f", "0.1f"), (r"= true;", "= false;"),
]  # fmt: skip


def mutants():
    """(file, line number, new line) of each possible change, comments and preprocessor lines left out."""
    for file in sorted((ROOT / "controller/limphome").glob("*.c")):
        in_comment = False
        for number, line in enumerate(file.read_text().splitlines()):
            in_comment = in_comment or line.lstrip().startswith("/*")
            if not in_comment and not line.startswith("#"):
                code = line.split("/*")[0]
                for old, new in CHANGES:
                    for match in re.finditer(old, code):
                        yield file.name, number, line[: match.start()] + new + line[match.end() :]
            in_comment = in_comment and "*/" not in line


def build(tests, sources, crawler, runner, folder):
    """Compiles the library and one program per test; None on success, else how it failed."""
    objects = []
    flags = ["-std=c11", "-O1", "-w", "-ffp-contract=off", "-D_DEFAULT_SOURCE", f"-I{folder}", f"-I{ROOT}/test/limphome"]
    for source in sources:
        objects.append(source.with_suffix(".o"))
        if not objects[-1].exists():
            run = subprocess.run(["gcc", *flags, "-c", source, "-o", objects[-1]], capture_output=True)
            if run.returncode:
                return "compiler"
    for test in tests:
        program = folder / test.stem
        if not (folder / f"{test.stem}.o").exists():
            subprocess.run(["gcc", *flags, "-c", test, "-o", folder / f"{test.stem}.o"], check=True)
        common = [folder / f"{test.stem}.o", *objects, crawler, runner]
        libraries = ["-lcheck", "-lsubunit", "-lrt", "-lpthread", "-lm"]
        subprocess.run(["gcc", *flags, *common, "-o", program, *libraries], check=True)
        try:
            if subprocess.run([program], capture_output=True, timeout=60).returncode:
                return test.stem
        except subprocess.TimeoutExpired:
            return test.stem
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--number", type=int, default=60, help="mutants to try")
    parser.add_argument("--seed", type=int, default=1, help="of their choice")
    parser.add_argument("--work", type=pathlib.Path, required=True, help="folder to work in")
    args = parser.parse_args()

    shutil.rmtree(args.work, ignore_errors=True)
    library = args.work / "limphome"
    shutil.copytree(ROOT / "controller/limphome", library)
    sources = sorted(library.glob("*.c"))
    tests = sorted((ROOT / "test/limphome").glob("test_*.c"))
    crawler, runner = ROOT / "test/limphome/crawler.c", ROOT / "test/limphome/runner.c"
    if (failed := build(tests, sources, crawler, runner, args.work)) is not None:
        raise SystemExit(f"the unchanged library fails {failed}")

    everything = list(mutants())
    chosen = random.Random(args.seed).sample(everything, min(args.number, len(everything)))
    survivors = 0
    for name, number, line in chosen:
        file = library / name
        original = file.read_text()
        lines = original.splitlines()
        lines[number] = line
        file.write_text("\n".join(lines) + "\n")
        file.with_suffix(".o").unlink(missing_ok=True)
        first = [t for t in tests if t.stem == f"test_{file.stem}"]  # the most likely to notice
        noticed = build(first + [t for t in tests if t not in first], sources, crawler, runner, args.work)
        survivors += noticed is None
        print(f"{'SURVIVED' if noticed is None else noticed:18} {name}:{number + 1}: {line.strip()}", flush=True)
        file.write_text(original)
        file.with_suffix(".o").unlink(missing_ok=True)
    print(f"{len(chosen)} of {len(everything)} mutants: {len(chosen) - survivors} noticed, {survivors} survived")


if __name__ == "__main__":
    main()
