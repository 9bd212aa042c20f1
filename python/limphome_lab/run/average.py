"""The mean of what a run of Q-learning knew at its last checkpoints.

A greedy policy goes by differences of Q that are no larger than what a few episodes change. The networks of a run have
one origin, unit by unit, so that their parameters have a mean; in it these changes even out (Polyak averaging).
"""

from copy import copy

from limphome_lab.runfolder import InputError
from limphome_lab.sealed import unseal


def read_policy(file):
    """The network in a checkpoint."""
    from limphome import checkpoint_t  # LCM is there once all is set up, and --help before

    checkpoint = unseal(checkpoint_t, file.read_bytes(), file)
    if checkpoint.learner != checkpoint_t.Q_LEARNING:
        raise InputError(f"{file}: there is no network in it that could be averaged")
    return checkpoint.policy


def average_policy(folder, count):
    """The newest policy, but with the mean weights, centres and widths of the last `count` checkpoints."""
    learner = folder.settings().get("learner", "kind", fallback="q_learning")
    if learner != "q_learning":
        raise InputError(f"--average: {folder.path} is of a {learner}; only networks of Q-learning have a mean")
    files = folder.checkpoint_files()[-count:]
    if not 1 <= count == len(files):
        raise InputError(f"--average {count}: must be from 1 to the number of checkpoints in {folder.checkpoints}")
    policies = [read_policy(file) for file in files]
    mean = copy(policies[-1])
    mean.weight = means(policy.weight for policy in policies)
    mean.width = means(policy.width for policy in policies)
    mean.centre = [means(rows) for rows in zip(*(policy.centre for policy in policies), strict=True)]
    return mean


def means(rows):
    """Of each column."""
    return [sum(column) / len(column) for column in zip(*rows, strict=True)]
