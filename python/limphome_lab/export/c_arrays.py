"""A learned policy as C: policy.h and robot.h, which the library on a microcontroller takes as they are."""

from limphome_lab import runfolder

FILES = ("robot.h", "policy.h")


def write(run, out):
    """Writes both into the folder `out`; their paths. InputError where the run has no policy yet."""
    run = runfolder.existing(run.path, "policy")
    out.mkdir(parents=True, exist_ok=True)
    named = ["--config", run.config, "--robot", run.robot, "--policy", run.policy]
    runfolder.ask("arrays", *named, "--out", out)
    return [out / name for name in FILES]
