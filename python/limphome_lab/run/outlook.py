"""What a training came to, and what one does next: the last words of scripts/train."""

from limphome_lab import command, paths
from limphome_lab.show.summary import summarise

LAST = 20  # episodes that are told of


def outlook(folder):
    """Lines for a person; none where the run has no episode."""
    last = folder.read_episodes()[-LAST:]
    if not last:
        return []
    came = summarise(last)
    goals = round(came["goal_share"] * came["episodes"])
    reached = f"the goal line was reached in {goals} of the last {came['episodes']} episodes"
    if goals:
        reached += f": after {came['median_duration_s']:.1f} s, {came['median_lateral_error_m']:.2f} m off its middle"
    run = paths.shown(folder.path)
    return [
        reached,
        f"  see it    {command.called('replay')} {run}",
        f"  drive it  {command.called('evaluate')} {run}",
        f"  yours     {command.called('robot')} --template >mine.urdf",
    ]
