"""A plant whose sensors lie or whose joints fail: python hazard_plant.py HAZARD URL COMMAND...

The plant of fake_plant.py with a clean link. HAZARD, a function below, alters what its sensors say from state AT of
each session on. Prints the exit code of COMMAND, a limphome-controller.
"""

import math
import subprocess
import sys
import time

from fake_plant import BOOM, PERIOD_S, SWING, FakePlant

from limphome import robot_state_t

AT = 5  # state from which something is wrong
PACE_S = 0.05  # of decisions in real time


def position_spike(state):
    if state.seq == AT:
        state.position = [state.position[0], state.position[1] + 300.0, 0.0]


def joint_jump(state):
    if state.seq == AT:
        angles = list(state.actuator_position)
        angles[SWING] += 2.0
        state.actuator_position = angles


def attitude_jump(state):
    if state.seq == AT:
        state.orientation = [0.0, 1.0, 0.0, 0.0]  # upside down


def invalid_attitude(state):
    if state.seq == AT:
        state.orientation = [0.0, 0.0, 0.0, 0.0]


def tilt(state):
    """By 0.95 rad to a side, short of a tumble."""
    if state.seq == AT:
        w, _, _, z = state.orientation
        c, s = math.cos(0.475), math.sin(0.475)
        state.orientation = [w * c, w * s, z * s, z * c]


def failed_joint(state):
    if state.seq >= AT:
        health = list(state.actuator_health)
        health[BOOM] = robot_state_t.FAILED
        state.actuator_health = health


def stuck_joint(_state):
    """See advance."""


def real_time(state):
    """A plant that does not wait, and whose position jumps."""
    state.lockstep = 0
    position_spike(state)


HAZARDS = {
    hazard.__name__: hazard
    for hazard in (
        position_spike,
        joint_jump,
        attitude_jump,
        invalid_attitude,
        tilt,
        failed_joint,
        stuck_joint,
        real_time,
    )
}


class HazardPlant(FakePlant):
    def __init__(self, url, hazard):
        self.hazard = hazard
        super().__init__(url, {"seed": 5})

    def state(self):
        state = super().state()
        HAZARDS[self.hazard](state)
        if state.lockstep == 0:
            state.utime = time.monotonic_ns() // 1000
        return state

    def advance(self, velocity):
        boom = self.angles[BOOM]
        super().advance(velocity)
        if self.hazard == "stuck_joint":
            self.angles[BOOM] = boom
        if self.hazard == "real_time":
            time.sleep(PACE_S)


def main():
    hazard, url, command = sys.argv[1], sys.argv[2], sys.argv[3:]
    assert PERIOD_S == 0.5, "limits of a jump are those of this period"
    plant = HazardPlant(url, hazard)
    controller = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        plant.serve(controller)
    finally:
        controller.kill()
    print(controller.wait())


if __name__ == "__main__":
    main()
