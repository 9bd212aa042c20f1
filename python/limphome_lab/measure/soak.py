"""Command soak: runs both processes for long, in lockstep and in real time, and tells whether anything grows that
should not, and how long the controller takes to answer."""

import json
import os
import statistics
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from limphome_lab import command, network, paths, runfolder
from limphome_lab.ending import Ending, with_exit_code

POLL_S = 0.05
SAMPLES = 500  # of a part, or one a second
WARM_UP = 0.2  # share of the samples in which memory may still grow
MOST_GROWTH_KB = 1024  # of a process afterwards
LOG_LIMIT_MB = 20  # of the recording
MOST_LOG = 1.5  # times the limit that the recording may take
ANSWER_EVERY_S = 0.2  # the plant's challenge
BIN_US = 10  # of the histogram
UNTIL_STOPPED = 1_000_000  # episodes
EDGES_US = (20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 50000, 100000)  # of the histogram that is printed


def sample(process):
    """Memory [kB], descriptors and threads of a process."""
    proc = Path(f"/proc/{process.pid}")
    status = dict(line.split(":", 1) for line in (proc / "status").read_text().splitlines())
    return {
        "memory_kb": int(status["VmRSS"].split()[0]),
        "descriptors": len(os.listdir(proc / "fd")),
        "threads": int(status["Threads"]),
    }


def take_samples(pair, folder):
    """Of both processes and of the recording, flat: {"simulator.memory_kb": 23000, ...}."""
    flat = {"log_mb": sum(file.stat().st_size for file in folder.path.glob("*.lcmlog*")) / 1e6}
    for child in (pair.simulator, pair.controller):
        for what, value in sample(child.process).items():
            flat[f"{child.name}.{what}"] = value
    return flat


def grown(samples):
    """Sentences on what grows that should not: from the end of the warm-up on, or beyond its limit."""
    if len(samples) < 10:
        return ["too short to tell whether anything grows"]
    settled = samples[round(len(samples) * WARM_UP) :]
    middle = len(settled) // 2
    wrong = []
    for what in (name for name in samples[0] if name != "log_mb"):
        before = max(each[what] for each in settled[:middle])
        after = max(each[what] for each in settled[middle:])
        if after - before > (MOST_GROWTH_KB if what.endswith("_kb") else 0):
            wrong.append(f"{what} grows: {before} in the first half, {after} in the second")
    most = max(each["log_mb"] for each in samples)
    if most > MOST_LOG * LOG_LIMIT_MB:
        wrong.append(f"the recording takes {most:.0f} MB, where its limit is {LOG_LIMIT_MB} MB")
    return wrong


class Histogram:
    """Latencies in bins, so that a soak does not grow itself."""

    def __init__(self):
        self.bins = Counter()
        self.worst = 0.0  # [s]

    def add(self, latencies):
        for latency in latencies:
            self.bins[int(latency * 1e6 / BIN_US)] += 1
            self.worst = max(self.worst, latency)

    def quantile(self, share):
        """Upper edge [s] of the bin in which it lies, but not above the worst; none counted: NaN."""
        left = share * self.bins.total()
        for number in sorted(self.bins):
            left -= self.bins[number]
            if left <= 0:
                return min((number + 1) * BIN_US * 1e-6, self.worst)
        return float("nan")

    def coarse(self):
        """[(below [us], how many)], for people; None: above all edges."""
        counts, lower = [], 0
        for upper in (*EDGES_US, None):
            within = range(lower // BIN_US, upper // BIN_US) if upper else None
            number = sum(
                count for bin_, count in self.bins.items() if (bin_ in within if within else bin_ * BIN_US >= lower)
            )
            counts.append((upper, number))
            lower = upper
        return counts


def soak(pace, url, config, done, length):
    """Runs the pair at `pace` until `done(latencies, seconds)` reaches `length`; returns what came of it."""
    from limphome_lab.measure.latency import Latencies
    from limphome_lab.run.arming import Operator  # LCM is there once all is set up, and --help before
    from limphome_lab.run.pair import Pair

    settings = [f"learning.episodes={UNTIL_STOPPED}", f"simulator.pace={pace}", f"recording.limit_mb={LOG_LIMIT_MB}"]
    histogram, samples, began = Histogram(), [], time.monotonic()
    every = max(1.0, length / SAMPLES) if pace == "real_time" else 1.0
    with tempfile.TemporaryDirectory() as work:
        folder = runfolder.create(
            Path(work) / "run", config, paths.CONFIG / "crawler.urdf", settings, real_time=pace == "real_time"
        )
        with Latencies(url_port(url)) as heard, Pair(folder, url) as pair, Operator(url, print, True) as operator:
            answered_at = sampled_at = 0.0
            while done(heard, time.monotonic() - began) < length:
                if pair.finished():
                    raise Ending(f"{pace}: all episodes are done")
                histogram.add(heard.take())
                now = time.monotonic()
                if now - answered_at >= ANSWER_EVERY_S:
                    operator.answer()
                    answered_at = now
                if now - sampled_at >= every:
                    samples.append({"s": now - began, "decisions": heard.answered, **take_samples(pair, folder)})
                    sampled_at = now
                time.sleep(POLL_S)
    return {
        "pace": pace,
        "decisions": heard.answered,
        "seconds": time.monotonic() - began,
        "latency_s": {"p50": histogram.quantile(0.5), "p99": histogram.quantile(0.99), "worst": histogram.worst},
        "histogram": [{"below_us": below, "number": number} for below, number in histogram.coarse()],
        "grown": grown([{name: each[name] for name in each if name not in ("s", "decisions")} for each in samples]),
        "samples": samples,
    }


def url_port(url):
    return int(url.split(":")[2].split("?")[0])


def report(part):
    """For people."""
    yield (
        f"{part['pace']}: {part['decisions']} decisions in {part['seconds']:.0f} s, "
        f"{part['decisions'] / part['seconds']:.0f} a second"
    )
    latency = part["latency_s"]
    yield (
        f"  state to command: p50 {latency['p50'] * 1e6:.0f} us, p99 {latency['p99'] * 1e6:.0f} us, "
        f"worst {latency['worst'] * 1e6:.0f} us"
    )
    for each in part["histogram"]:
        below = f"< {each['below_us']:>6} us" if each["below_us"] else "    and above"
        yield f"    {below}  {each['number']}"
    names = [name for name in part["samples"][0] if name not in ("s", "decisions")] if part["samples"] else []
    for name in names:
        values = [each[name] for each in part["samples"]]
        yield f"  {name:<26} median {statistics.median(values):.0f}, most {max(values):.0f}, last {values[-1]:.0f}"
    yield from (f"  FAILED: {sentence}" for sentence in part["grown"])


def draw(parts, path):
    """What was sampled over time, one row a part."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, rows = pyplot.subplots(len(parts), 3, figsize=(14, 4 * len(parts)), squeeze=False)
    for row, part in zip(rows, parts, strict=True):
        times = [each["s"] for each in part["samples"]]
        for axes, kind, unit in zip(row, ("memory_kb", "descriptors", "log_mb"), ("kB", "", "MB"), strict=True):
            for name in (name for name in part["samples"][0] if name.endswith(kind)):
                axes.plot(times, [each[name] for each in part["samples"]], label=name)
            axes.set(title=part["pace"], xlabel="time [s]", ylabel=f"{kind.split('_')[0]} [{unit}]" if unit else kind)
            axes.set_ylim(bottom=0)
            axes.legend()
    figure.tight_layout()
    figure.savefig(path)


def parse_arguments():
    parser = command.parser(
        "soak",
        "Runs both processes for long; fails if memory, descriptors, threads or the recording grow without bound.",
        "--decisions 100000 --seconds 600 --json soak.json",
    )
    parser.add_argument("--decisions", type=int, default=1_000_000, metavar="N", help="in lockstep; 0: not at all")
    parser.add_argument("--seconds", type=float, default=3600, metavar="S", help="in real time; 0: not at all")
    parser.add_argument("--config", default=paths.CONFIG / "paper.ini", help="experiment (INI)")
    parser.add_argument("--json", type=command.file_to_write, metavar="FILE", help="write all figures, samples too")
    parser.add_argument("--plot", type=command.file_to_write, metavar="FILE", help="draw the samples (PNG, SVG)")
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for train")
    return parser.parse_args()


@with_exit_code
def main():
    args = parse_arguments()
    url = network.enter(args.network)
    parts = []
    for pace, length, done in (
        ("lockstep", args.decisions, lambda heard, _: heard.answered),
        ("real_time", args.seconds, lambda _, seconds: seconds),
    ):
        if length > 0:
            parts.append(soak(pace, url, args.config, done, length))
            print(*report(parts[-1]), sep="\n", flush=True)
    if args.json:
        args.json.write_text(json.dumps(parts, indent=2) + "\n")
    if args.plot and parts:
        draw(parts, args.plot)
    return 1 if any(part["grown"] for part in parts) else 0


if __name__ == "__main__":
    sys.exit(main())
