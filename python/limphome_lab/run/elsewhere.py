"""Settings of an evaluation: those of the training, but for another seed, another world, other poses to begin from."""

from limphome_lab import runfolder
from limphome_lab.runfolder import InputError

# What is learned is one with these; of another experiment all else is taken. A period decides how far an action leads.
OF_THE_POLICY = ("learner", "learning", "rbf", "exploration", "planner", "evaluation", "action", "reward")
PERIOD = ("episode", "decision_period_s")

POSES = {  # drawn at each reset unless told otherwise: greedy episodes from one pose would be one sample repeated
    "randomisation.position_m": "0.5",
    "randomisation.heading_rad": "0.1",
    "randomisation.joint_rad": "0.2",
}
EACH_FROM_A_POSE = "episode.reset_every=1"  # where episodes do not hang together by a path


def assignments(trained, config=None, seed=None, own=()):
    """["section.key=value"] over the training's config.ini; `own` are the user's, which have the last word."""
    found = [] if config is None else world_of(config, trained.settings())
    if seed is not None:
        found.append(f"learning.seed={seed}")
    settings = runfolder.parse_settings(runfolder.resolve_settings(trained.config, [*found, *own]), trained.config)
    if names(own) & set(POSES):
        return [*found, *own]
    found += [f"{name}={value}" for name, value in POSES.items() if float(setting(settings, name)) == 0]
    if settings["task"]["path"] == "rolling" and "episode.reset_every" not in names(own):
        found.append(EACH_FROM_A_POSE)
    return [*found, *own]


def names(given):
    return {each.partition("=")[0].strip() for each in given}


def setting(settings, name):
    section, _, key = name.partition(".")
    return settings[section][key]


def world_of(config, trained):
    """What an experiment sets otherwise than the training's settings of the robot's world and of its task."""
    settings = runfolder.parse_settings(runfolder.resolve_settings(config, []), config)
    return [
        f"{section}.{key}={value}"
        for section in settings.sections()
        if section not in OF_THE_POLICY
        for key, value in settings[section].items()
        if (section, key) != PERIOD and value != trained[section][key]
    ]


def check_fits(trained, assignments):
    """InputError, naming the keys, where what was learned cannot drive with these settings."""
    was = trained.settings()
    now = runfolder.parse_settings(runfolder.resolve_settings(trained.config, assignments), trained.config)
    bound = ["learner.kind", "action.crawler_speed", "action.joint_speed"]
    if was["learner"]["kind"] == "planner":
        bound += [".".join(PERIOD), "planner.mechanics"]
    faults = [
        f"{name} = {setting(now, name)}: {trained.path.name} has learned with {setting(was, name)} and drives with "
        "nothing else"
        for name in bound
        if setting(now, name) != setting(was, name)
    ]
    before, after = failed(was), failed(now)
    if before != after:
        faults.append(
            f"{listed(after)} cannot be driven from the start, but {trained.path.name} has learned to do without "
            f"{listed(before)}: what is learned is for the actuators that are left; a failure on the way "
            "(failure.at_s above 0), a weak one, or one more failure on the way can be tried"
        )
    if faults:
        raise InputError("\n".join(faults))


def failed(settings):
    """Actuators that do not obey from the start, which no policy drives."""
    return {
        section["actuator"]
        for section in (settings["failure"], settings["second_failure"])
        if section["actuator"] != "none"
        and section["mode"] != "weak"
        and float(section["at_s"]) == float(section["at_episode"]) == 0
    }


def listed(actuators):
    return " and ".join(sorted(actuators)) or "no actuator"
