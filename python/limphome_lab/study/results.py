"""Command results: a page about the experiments that run folders belong to, and its figures."""

import shutil
import statistics
import sys
from itertools import groupby
from pathlib import Path

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run.manifest import EVALUATION, SHARES
from limphome_lab.show import experiments
from limphome_lab.show.progress import clock
from limphome_lab.show.summary import summarise

SECTIONS = {"q_learning": "The paper's method", "planner": "The planner"}  # by kind of learner
OTHERS = {"stable_baselines3": "A learner of others: DQN of Stable-Baselines3"}  # told of in notes alone
STRETCH = 250  # episodes at the end of a run that its row tells of
OWN_ROBOT = paths.CONFIG / "crawler.urdf"
VARIED = {("learning", "seed"), ("learning", "episodes")}  # within one experiment
WINDOW, GOALS, DURATION_S = 20, 19, 12  # of what counts as learned
FIGURES = {
    "fig8_reward": "Total reward of each episode (the paper's Fig. 8)",
    "fig7_trajectories": "Way of the robot in the first and the last episode (Fig. 7)",
    "fig9_motion": "Motion in the last episode (Fig. 9)",
    "fig_learning": "Duration, lateral error and share of goals",
}
COLUMNS = (
    "seed",
    "learned after [episodes]",
    "[decisions]",
    "reached the goal [%]",
    "duration [s]",
    "lateral error [m]",
    "change of heading [rad]",
    "total reward",
    "tumbles in all",
)


class Run(experiments.Run):
    """One that counts, with the name of its experiment."""

    def __init__(self, path):
        super().__init__(path)
        if not self.finished:
            raise runfolder.InputError(f"{path}: the run has not finished")
        if self.manifest.get("kind") == EVALUATION:
            raise runfolder.InputError(f"{path}: is an evaluation; results are of trainings")
        self.learner = self.settings.get("learner", "kind", fallback="q_learning")
        self.name = ", ".join([self.manifest["config"], *deviations(self)])


def deviations(run):
    """What was set otherwise than in config/CONFIG.ini (paper.ini where there is none): ["mode = free", ...]."""
    file = paths.CONFIG / f"{run.manifest['config']}.ini"
    text = runfolder.resolve_settings(file if file.exists() else paths.CONFIG / "paper.ini", [])
    standard = runfolder.parse_settings(text, file)
    found = [
        f"{key} = {value}"
        for section in run.settings.sections()
        for key, value in run.settings[section].items()
        if (section, key) not in VARIED and standard.get(section, key, fallback=None) != value
    ]
    robot, text = run.facts["robot"]
    return found if text == OWN_ROBOT.read_text() else [*found, f"robot = {robot}"]


def check_apart(runs):
    """InputError where two runs would be told of as one, or one seed would count twice."""
    for _, same in groupby(runs, key=lambda run: (run.learner, run.name)):
        same = list(same)
        seeds = [run.seed for run in same]
        twice = next((run for run in same if seeds.count(run.seed) > 1), None)
        if twice is not None:
            both = " and ".join(str(run.folder.path) for run in same if run.seed == twice.seed)
            raise runfolder.InputError(f"seed {twice.seed} of {twice.name} would count twice: {both}")
        differing = [key for key in same[0].facts if len({run.facts.get(key) for run in same}) > 1]
        if set(differing) - {"learning.episodes"}:
            raise runfolder.InputError(f"runs of {same[0].name} differ in {', '.join(differing)}: not one experiment")


def learned_after(episodes):
    """Least n such that of the WINDOW episodes after the first n GOALS reach the goal, in DURATION_S at the median; or
    None."""
    for n in range(len(episodes) - WINDOW + 1):
        window = episodes[n : n + WINDOW]
        goals = sum(episode.outcome == "goal" for episode in window)
        if goals >= GOALS and statistics.median(episode.duration_s for episode in window) <= DURATION_S:
            return n
    return None


def stretch(episodes):
    """Episodes at the end that tell how it ended: a tenth of a short run."""
    return STRETCH if len(episodes) >= 10 * STRETCH else max(1, len(episodes) // 10)


def markdown_table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def row(run):
    learned = learned_after(run.episodes)
    last = summarise(run.episodes[-stretch(run.episodes) :])
    return (
        run.seed,
        learned if learned is not None else "never" if len(run.episodes) >= WINDOW else "",
        "" if learned is None else sum(episode.steps for episode in run.episodes[:learned]),
        f"{100 * last['goal_share']:.0f}",
        f"{last['median_duration_s']:.1f}",
        f"{last['median_lateral_error_m']:.2f}",
        f"{last['median_heading_change_rad']:.2f}",
        f"{last['median_reward']:.2f}",
        sum(episode.outcome == "tumble" for episode in run.episodes),
    )


def span(values, form):
    low, high = form(min(values)), form(max(values))
    return low if low == high else f"{low} to {high}"


def summary(runs):
    """How many have learned, and when."""
    if all(len(run.episodes) < WINDOW for run in runs):
        return f"**{span([len(run.episodes) for run in runs], str)} episodes are too few to have learned by.**"
    learned = [n for n in (learned_after(run.episodes) for run in runs) if n is not None]
    text = f"**Learned on {len(learned)} of {len(runs)} seeds"
    if learned:
        text += f", after {span(learned, str)} episodes, {statistics.median(learned):g} at the median"
    return text + ".**"


def cost(runs):
    """What the runs took, and on what."""

    def of(name):
        return [run.manifest[name] for run in runs]

    machines = sorted(
        f"{cpu}, {cores} cores, {system}"
        for cpu, cores, system in {(m["cpu"], m["cores"], m["os"]) for m in of("machine")}
    )
    revisions = sorted({f"`{(each['commit'] or 'unknown')[:10]}`" for each in of("revision")})
    return (
        f"Each run took {span(of('wall_time_s'), clock)}{work(runs)}. {'; '.join(machines)}; "
        f"revision {', '.join(revisions)}"
        + (" with changes." if any(each["dirty"] for each in of("revision")) else ".")
    )


def work(runs):
    """What the processes did in that time, by those runs that tell: some end before both have told of themselves."""
    told = [run.manifest for run in runs if "decisions" in run.manifest]
    if not told:
        return ""
    decisions, rates = ([manifest[name] for manifest in told] for name in ("decisions", "decisions_per_s"))
    shares = " + ".join(f"{statistics.median(manifest[share] for manifest in told):.0%}" for share in SHARES)
    return (
        f" for {span(decisions, str)} decisions, {span(rates, '{:.0f}'.format)} a second, of which simulator + "
        f"controller + link had {shares} at the median"
    )


def best(runs):
    """The run that ended with the largest median reward."""
    return max(runs, key=lambda run: summarise(run.episodes[-stretch(run.episodes) :])["median_reward"])


def file_name(name):
    return name.replace(", ", "-").replace(" = ", "-")


def copy_figures(run, out):
    """Markdown that shows the figures of one run, copied to images/; a study draws none, so they are drawn here."""
    images = out / "images"
    images.mkdir(parents=True, exist_ok=True)
    if not all((run.folder.figures / f"{figure}.png").exists() for figure in FIGURES):
        from limphome_lab.show.figures import draw_all  # matplotlib takes most of a second to load

        draw_all(run.folder)
    shown = []
    for figure, caption in FIGURES.items():
        name = f"{file_name(run.name)}-seed{run.seed}-{figure}.png"
        shutil.copyfile(run.folder.figures / f"{figure}.png", images / name)
        shown.append(f"![{caption}](images/{name})\n\n*{caption}; {run.name}, seed {run.seed}, which ended best.*")
    return "\n\n".join(shown)


def draw_seeds(name, runs, out):
    """Markdown that shows every episode of every seed."""
    from limphome_lab.show.figures import seeds, style  # matplotlib takes most of a second to load

    image = f"{file_name(name)}-seeds.png"
    (out / "images").mkdir(parents=True, exist_ok=True)
    figure = seeds.draw(
        {run.seed: run.episodes for run in runs}, {run.seed: learned_after(run.episodes) for run in runs}
    )
    style.save(figure, out / "images" / image)
    return (
        f"![Every episode of every seed](images/{image})\n\n*Every episode of every seed, both axes logarithmic; the "
        f"green line is where it had learned; {name}.*"
    )


def experiment(name, runs, out):
    counts = sorted({stretch(run.episodes) for run in runs})
    parts = [
        f"### {name}",
        summary(runs),
        f"The last {' or '.join(map(str, counts))} of {span([len(run.episodes) for run in runs], str)} episodes of "
        "each run; duration, lateral error and change of heading (their magnitudes) and reward are medians.",
        markdown_table(COLUMNS, map(row, runs)),
        draw_seeds(name, runs, out),
    ]
    return "\n\n".join([*parts, cost(runs)])


def section(learner, runs, out):
    """What was written of the learner in results_LEARNER.md beside the page, figures of its first experiment, and all
    of them."""
    notes = out / f"results_{learner}.md"
    parts = [f"## {SECTIONS[learner]}"]
    if notes.exists():
        parts.append(notes.read_text().strip())
    groups = [list(group) for _, group in groupby(runs, key=lambda run: run.name)]
    parts.append(copy_figures(best(groups[0]), out))
    parts += [experiment(group[0].name, group, out) for group in groups]
    return "\n\n".join(parts)


def document(runs, out):
    """The page; its figures are left in `out`."""
    order = list(SECTIONS)
    runs = sorted(runs, key=lambda run: (order.index(run.learner), run.name, run.seed))
    check_apart(runs)
    revisions = sorted({(run.manifest["revision"]["commit"] or "unknown")[:10] for run in runs})
    parts = [
        "# Results",
        f"Written by `scripts/results` from {len(runs)} run folders that `scripts/train` left, by revision "
        f"{', '.join(f'`{each}`' for each in revisions)}. *Learned* after n episodes: of the "
        f"{WINDOW} episodes that follow at least {GOALS} reach the goal, in {DURATION_S} s or less at the median; n is "
        "the least such number.",
    ]
    parts += [section(learner, list(group), out) for learner, group in groupby(runs, key=lambda run: run.learner)]
    for name, title in OTHERS.items():
        notes = out / f"results_{name}.md"
        if notes.exists():
            parts.append(f"## {title}\n\n{notes.read_text().strip()}")
    return "\n\n".join(parts) + "\n"


@with_exit_code
def main():
    parser = command.parser(
        "results",
        "Writes results.md, and its figures into images/, from the run folders of one or more experiments, each told "
        "of by itself.",
        "runs/paper-seed* --out results",
    )
    parser.add_argument(
        "runs", metavar="RUN", nargs="+", type=runfolder.named, help="run folder, folder of such, or folder of a study"
    )
    parser.add_argument("--out", metavar="DIR", default="results", help="folder for the page; default results")
    args = parser.parse_args()
    found, passed_over = experiments.find(args.runs)
    for each in passed_over:
        print(each, file=sys.stderr)
    out = Path(args.out)
    text = document([Run(run.folder.path) for run in found], out)
    out.mkdir(parents=True, exist_ok=True)
    (out / "results.md").write_text(text)
    print(paths.shown(out / "results.md"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
