"""report.md and report.html of a study: what each case came to, on test seeds and on tuning seeds, and every seed."""

import math
import statistics

from limphome_lab import command, paths
from limphome_lab.show import learned
from limphome_lab.show.figures import style
from limphome_lab.show.progress import clock
from limphome_lab.study import figures, intervals, outcome
from limphome_lab.study.document import Figure, Heading, Paragraph, Table, html, markdown
from limphome_lab.study.intervals import NEVER

CRITERION = (
    f"Learned at n: the least n such that the next {learned.WINDOW} episodes have at least {learned.GOALS} goals, no "
    f"tumble, and medians of at most {learned.LATERAL_ERROR_M:.2f} m beside the line, "
    f"{math.degrees(learned.HEADING_CHANGE_RAD):.0f} degrees of turn and {learned.DURATION_S:.0f} s; where a case is "
    f"marked hard, the larger of that and {learned.PACE_MARGIN} times the run's own best pace. Held: share of the "
    "windows from there to the run's end that fulfil it. Robot minutes: duration of episodes 1 to n. Intervals are of "
    "95 %: exact for shares (Clopper and Pearson), bootstrap for medians, in which a seed that never learned counts as "
    "above all others."
)
SUMMARY = (
    "case",
    "learned",
    "n, median",
    "n, worst",
    "held, median",
    "held always",
    "robot minutes",
    f"last {learned.LAST}: duration",
    f"last {learned.LAST}: beside the line",
    "tumbles",
    "wall time",
)
DRIVEN = ("case", "evaluation", "runs", "reached every goal", "duration, median", "beside the line, median", "worst")
SEED = (
    "seed",
    "learned at",
    "held",
    "robot minutes",
    "duration",
    "beside the line",
    "tumbles",
    "wall time",
    "evaluated",
)


def write_report(plan):
    """Writes both; returns their paths."""
    (plan.out / "figures").mkdir(exist_ok=True)
    outcomes = {case: [] for case in plan.table.cases}
    for run in plan.runs:
        outcomes[run.case].append(outcome.read(plan, run))
    blocks = page(plan, outcomes)
    texts = {"report.md": markdown(blocks), "report.html": html(f"Study {plan.table.name}", blocks)}
    for name, text in texts.items():
        (plan.out / name).write_text(text)
    return [plan.out / name for name in texts]


def page(plan, outcomes):
    table = plan.table
    counted = {case: [each for each in found if each.episodes] for case, found in outcomes.items()}
    blocks = [
        Heading(1, f"Study {table.name}"),
        Paragraph(f"Written by {command.called('study')} from {paths.shown(table.path)}. {seeds(table)}"),
        Paragraph(CRITERION),
        *provenance(counted),
        *missing(outcomes),
    ]
    for use in ("test", "tuning"):
        blocks += results(use, {case: [each for each in found if each.use == use] for case, found in counted.items()})
    if any(counted.values()):
        blocks += courses(plan, counted)
    return blocks


def seeds(table):
    given = [f"{use.capitalize()} seeds: {ranges(numbers)}." for use, numbers in table.seeds.items() if numbers]
    return " ".join(given)


def ranges(numbers):
    """1, 2, 3, 7 as "1-3, 7"."""
    found = []
    for number in sorted(numbers):
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return ", ".join(f"{first}-{last}" if first < last else f"{first}" for first, last in found)


def provenance(counted):
    """On what machines, by what revisions."""
    manifests = [each.manifest for found in counted.values() for each in found]
    machines = sorted({f"{each['machine']['cpu']}, {each['machine']['cores']} cores" for each in manifests})
    revisions = sorted(
        {
            (each["revision"]["commit"] or "unknown")[:10] + (" with changes" if each["revision"]["dirty"] else "")
            for each in manifests
        }
    )
    return [Paragraph(f"Made on {'; '.join(machines)}; revision {', '.join(revisions)}.")] if manifests else []


def missing(outcomes):
    """What does not count, and why."""
    rows = []
    for case, found in outcomes.items():
        for each in found:
            if each.missing:
                rows.append((case.name, each.seed, "run", each.missing))
            rows += [(case.name, each.seed, name, why) for name, why in each.not_evaluated.items()]
    return [Heading(2, "Not counted"), Table(("case", "seed", "what", "why"), rows)] if rows else []


def results(use, counted):
    """The tables of test seeds or of tuning seeds."""
    rows = [summary_row(case, found) for case, found in counted.items() if found]
    if not rows:
        return []
    blocks = [Heading(2, f"On {use} seeds"), Table(SUMMARY, rows)]
    driven = [row for case, found in counted.items() for row in driven_rows(case, found)]
    return blocks + (
        [Paragraph("What was learned, evaluated without learning:"), Table(DRIVEN, driven)] if driven else []
    )


def summary_row(case, found):
    learners = [each for each in found if each.n is not None]
    low, high = intervals.share(len(learners), len(found))
    n = [NEVER if each.n is None else each.n for each in found]
    last = [learned.last(each.episodes) for each in found]
    return (
        case.name + (" (hard)" if case.hard else ""),
        f"{len(learners)} of {len(found)} ({low:.0%} to {high:.0%})",
        episodes(intervals.middle(n)) + span(intervals.median(n)),
        episodes(max(n)),
        middle([each.held for each in learners], "{:.0%}"),
        f"{sum(each.held == 1 for each in learners)} of {len(learners)}" if learners else "",
        middle([each.robot_minutes for each in learners], "{:.1f}"),
        middle([duration for duration, _ in last], "{:.2f} s"),
        middle([lateral for _, lateral in last], "{:.3f} m"),
        sum(each.tumbles for each in found),
        middle([each.wall_time_s for each in found], "{:.1f} s"),
    )


def episodes(n):
    return "never" if n == NEVER else f"{n:g}"


def span(interval):
    return "" if interval in (None, (NEVER, NEVER)) else f" ({episodes(interval[0])} to {episodes(interval[1])})"


def middle(values, form):
    """Median as text; nothing where there is none."""
    return form.format(statistics.median(values)) if values else ""


def driven_rows(case, found):
    """One for each evaluation of a case."""
    for name in dict.fromkeys(name for each in found for name in each.evaluations):
        summaries = [each.evaluations[name] for each in found if name in each.evaluations]
        laterals = [summary["median_lateral_error_m"] for summary in summaries]
        yield (
            case.name,
            name,
            len(summaries),
            f"{sum(summary['goal_share'] == 1 for summary in summaries)} of {len(summaries)}",
            middle([summary["median_duration_s"] for summary in summaries], "{:.1f} s"),
            middle(laterals, "{:.3f} m"),
            f"{max(laterals):.3f} m",
        )


def courses(plan, counted):
    """Figures, and a table of every seed of each case."""
    shown = {case: found for case, found in counted.items() if found}
    style.save(
        figures.draw_learned({case.name: found for case, found in shown.items()}), plan.out / "figures" / "learned.png"
    )
    blocks = [Heading(2, "Every seed"), Figure("figures/learned.png", "When each seed had learned")]
    for case, found in shown.items():
        file = f"figures/{case.name}.png"
        limit = max(learned.duration_limit(each.episodes, case.hard) for each in found)
        style.save(figures.draw_course(found, limit), plan.out / file)
        caption = f"{case.name}: every seed, over the {learned.WINDOW} episodes up to each; dashed: the criterion"
        blocks += [Heading(3, case.name), Figure(file, caption), Table(SEED, [seed_row(each) for each in found])]
    return blocks


def seed_row(each):
    duration, lateral = learned.last(each.episodes)
    return (
        f"{each.seed} ({each.use})",
        "never" if each.n is None else each.n,
        "" if each.held is None else f"{each.held:.0%}",
        "" if each.robot_minutes is None else f"{each.robot_minutes:.1f}",
        f"{duration:.2f} s",
        f"{lateral:.3f} m",
        each.tumbles,
        clock(each.wall_time_s),
        "; ".join(f"{name}: {driven(summary)}" for name, summary in each.evaluations.items()),
    )


def driven(summary):
    return (
        f"{summary['goal_share']:.0%} goals, {summary['median_duration_s']:.1f} s, "
        f"{summary['median_lateral_error_m']:.3f} m"
    )
