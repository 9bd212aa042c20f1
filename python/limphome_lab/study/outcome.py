"""What came out of each run of a study, read from the folders that it left."""

import json
from dataclasses import dataclass, field

from limphome_lab import runfolder
from limphome_lab.show import learned
from limphome_lab.show.summary import summarise
from limphome_lab.study.plan import is_asked_for

LOG_TAIL = 3  # lines that tell why a run failed
CHANGED = "robot or programs were changed while the study was under way"


@dataclass
class Outcome:
    """Of one seed. `episodes` is empty where there is no run that counts; `missing` then tells why."""

    seed: int
    use: str  # "tuning" or "test"
    episodes: list
    missing: str = ""
    n: int | None = None  # learned at; None: not learned
    held: float | None = None
    robot_minutes: float | None = None
    wall_time_s: float = 0.0
    manifest: dict = field(default_factory=dict)
    evaluations: dict = field(default_factory=dict)  # summary by name
    not_evaluated: dict = field(default_factory=dict)  # why, by name

    @property
    def tumbles(self):
        return sum(episode.outcome == "tumble" for episode in self.episodes)


def read(plan, run):
    """The Outcome of one plan.Run."""
    use = "test" if run.seed in plan.table.seeds["test"] else "tuning"
    folder = runfolder.RunFolder(plan.folder(run))
    if not folder.path.exists():
        return Outcome(run.seed, use, [], missing=why_missing(plan, run.name))
    manifest = json.loads(folder.manifest.read_text())
    if not is_asked_for(run, manifest):
        return Outcome(run.seed, use, [], missing=CHANGED)
    episodes, hard = folder.read_episodes(), run.case.hard
    found = Outcome(
        run.seed,
        use,
        episodes,
        n=learned.learned_at(episodes, hard),
        held=learned.held(episodes, hard),
        robot_minutes=learned.robot_minutes(episodes, hard),
        wall_time_s=manifest["wall_time_s"],
        manifest=manifest,
    )
    for name in run.evaluations:
        read_evaluation(plan, run, name, found)
    return found


def read_evaluation(plan, run, name, found):
    """Adds an evaluation to the Outcome of its run."""
    folder = runfolder.RunFolder(plan.evaluation_folder(run, name))
    if not folder.path.exists():
        found.not_evaluated[name] = why_missing(plan, folder.path.name)
    elif json.loads(folder.manifest.read_text())["digests"] != found.manifest["digests"]:
        found.not_evaluated[name] = CHANGED
    else:
        found.evaluations[name] = summarise(folder.read_episodes())


def why_missing(plan, name):
    """Last words of the command that did not leave the folder `name`."""
    log = plan.out / "logs" / f"{name}.log"
    if not log.exists():
        return "not begun"
    words = " ".join(log.read_text(errors="replace").split("\n")[-LOG_TAIL - 1 :]).strip()
    return f"failed: {words}" if words else "not finished"
