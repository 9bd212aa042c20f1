"""The cases: each yields quantities with a reference, where that comes from, and what the simulator gave."""

from limphome_lab.measure.validation.cases import arm, driving, falling, grip, obstacles, pulling, slopes

ALL = (
    falling.free_fall,
    falling.rest,
    falling.swing_without_friction,
    falling.passive,
    driving.straight_drive,
    driving.locked_crawler,
    driving.free_crawler,
    driving.counter_rotation,
    driving.turning_radius,
    grip.nothing_resists,
    grip.standing_after_turns,
    grip.loads_are_shared,
    grip.stalled,
    pulling.drawbar_pull,
    pulling.pull_and_slip,
    pulling.motion_resistance,
    pulling.stall,
    slopes.rolling_down,
    slopes.slopes,
    slopes.ramp_grid,
    slopes.holding,
    slopes.across,
    slopes.tipping,
    slopes.swinging,
    obstacles.steps,
    obstacles.gaps,
    arm.arm_pressed,
    arm.pressing_torques,
    arm.lifting_drive,
)


def measure(progress=lambda name: None):
    quantities = []
    for case in ALL:
        progress(case.__name__.replace("_", " "))
        quantities += case()
    return quantities
