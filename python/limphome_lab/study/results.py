"""Command results: writes docs/results.md, and its figures, from run folders."""

import json
import shutil
import sys
from itertools import groupby

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run.manifest import SHARES
from limphome_lab.show.progress import clock
from limphome_lab.show.summary import summarise

DOCS = paths.ROOT / "docs"
STRETCH = 250  # episodes at either end of a run that are compared
FIGURES = {
    "fig8_reward": "Total reward of each episode (the paper's Fig. 8)",
    "fig7_trajectories": "Way of the robot in the first and the last episode (Fig. 7)",
    "fig9_motion": "Motion in the last episode (Fig. 9)",
    "fig_learning": "Duration, lateral error and share of goals",
}
LEARNING_COLUMNS = (
    "seed",
    "episodes",
    "reached the goal [%]",
    "duration [s]",
    "lateral error [m]",
    "total reward",
    "tumbles",
)
COST_COLUMNS = (
    "seed",
    "wall time",
    "times real time",
    "decisions",
    "decisions/s",
    "wall time in simulator + controller + link",
    "revision",
)


class Run:
    def __init__(self, path):
        self.folder = runfolder.existing(path, "episodes", "manifest", "figures")
        self.manifest = json.loads(self.folder.manifest.read_text())
        self.episodes = self.folder.read_episodes()
        if self.manifest.get("result") != "finished":
            raise runfolder.InputError(f"{path}: the run has not finished")

    @property
    def name(self):
        return self.manifest["config"]

    @property
    def seed(self):
        return self.manifest["seed"]


def stretch(episodes):
    """Episodes compared at either end: a tenth of a short run."""
    return STRETCH if len(episodes) >= 10 * STRETCH else max(1, len(episodes) // 10)


def markdown_table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def learning_row(run):
    """Each figure as first stretch → last stretch."""
    count = stretch(run.episodes)
    first, last = summarise(run.episodes[:count]), summarise(run.episodes[-count:])

    def both(name, form, factor=1):
        return f"{first[name] * factor:{form}} → {last[name] * factor:{form}}"

    tumbles = sum(episode.outcome == "tumble" for episode in run.episodes)
    return (
        run.seed,
        len(run.episodes),
        both("goal_share", ".0f", 100),
        both("median_duration_s", ".1f"),
        both("median_lateral_error_m", ".2f"),
        both("median_reward", ".2f"),
        f"{first['tumbles']} → {last['tumbles']} ({tumbles} in all)",
    )


def cost_row(run):
    manifest = run.manifest
    commit, dirty = manifest["revision"]["commit"], manifest["revision"]["dirty"]
    return (
        run.seed,
        clock(manifest["wall_time_s"]),
        f"{manifest['real_time_factor']:.0f}",
        manifest["decisions"],
        f"{manifest['decisions_per_s']:.0f}",
        " + ".join(f"{manifest[share]:.0%}" for share in SHARES),
        f"`{(commit or 'unknown')[:10]}`" + (" with changes" if dirty else ""),
    )


def best(runs):
    """The run that ended with the largest median reward: the one whose figures are shown."""
    return max(runs, key=lambda run: summarise(run.episodes[-stretch(run.episodes) :])["median_reward"])


def copy_figures(run, note):
    """Markdown that shows the figures of one run, copied to docs/images/."""
    images = DOCS / "images"
    images.mkdir(parents=True, exist_ok=True)
    shown = []
    for figure, caption in FIGURES.items():
        name = f"{run.name}-seed{run.seed}-{figure}.png"
        shutil.copyfile(run.folder.figures / f"{figure}.png", images / name)
        shown.append(f"![{caption}](images/{name})\n\n*{caption}; {run.name}, seed {run.seed}{note}.*")
    return "\n\n".join(shown)


def draw_seeds(name, runs):
    """Markdown that shows how the reward went on every seed."""
    from limphome_lab.show.figures import reward, style  # matplotlib takes most of a second to load

    image = f"{name}-seeds.png"
    style.save(reward.draw_seeds({run.seed: run.episodes for run in runs}), DOCS / "images" / image)
    return (
        f"![Total reward on every seed](images/{image})\n\n*Running median of the total reward on every seed; {name}.*"
    )


def section(name, runs):
    counts = sorted({stretch(run.episodes) for run in runs})
    machines = sorted(
        {
            f"{run.manifest['machine']['cpu']}, {run.manifest['machine']['cores']} cores, "
            f"{run.manifest['machine']['os']}"
            for run in runs
        }
    )
    return "\n\n".join(
        [
            f"## {name}",
            f"First → last {' or '.join(map(str, counts))} episodes of each run; duration, lateral error (its "
            "magnitude) and reward are medians.",
            markdown_table(LEARNING_COLUMNS, map(learning_row, runs)),
            f"What it took, on {'; '.join(machines)}:",
            markdown_table(COST_COLUMNS, map(cost_row, runs)),
            copy_figures(best(runs), ", which ended best" if len(runs) > 1 else ""),
            draw_seeds(name, runs),
        ]
    )


def document(runs):
    runs = sorted(runs, key=lambda run: (run.name, run.seed))
    notes = DOCS / "results_notes.md"
    parts = ["# Results", "Written by `scripts/results` from run folders that `scripts/train` left."]
    if notes.exists():
        parts.append(notes.read_text().strip())
    parts += [section(name, list(group)) for name, group in groupby(runs, key=lambda run: run.name)]
    return "\n\n".join(parts) + "\n"


@with_exit_code
def main():
    parser = command.parser("results", "Writes docs/results.md from run folders.", "runs/paper-seed*")
    parser.add_argument("runs", metavar="RUN", nargs="+", help="run folder that has finished")
    args = parser.parse_args()
    (DOCS / "results.md").write_text(document([Run(path) for path in args.runs]))
    print(paths.shown(DOCS / "results.md"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
