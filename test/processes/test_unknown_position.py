"""A robot that does not know where it is: which inputs a policy loses, and how it drives then. docs/real_robot.md tells
what is measured here."""

import math

import lcm
from bus import Bus, inside, settings

from conftest import ROOT, run_script
from limphome import robot_state_t, velocity_command_t
from limphome_lab import network, paths, quaternion
from limphome_lab.channels import COMMAND, RESET, STATE
from limphome_lab.runfolder import RunFolder

DECISIONS = 40
RIGHT_CRAWLER = 1
STRAIGHT = ["task.path=ahead", "episode.goal_distance_m=50", "safety.monitor=on"]
OTHER_PORT = network.PORT + 1


class Relay:
    """Between a plant and a controller that are on two buses; what the plant's sensors tell is changed by `sensed`."""

    def __init__(self, sensed):
        self.sensed = sensed
        self.plant, self.controller = lcm.LCM(network.lcm_url()), lcm.LCM(network.lcm_url(OTHER_PORT))
        self.states, self.commands = [], []  # as they are; each once
        self.plant.subscribe(STATE, self.on_state).set_queue_capacity(500)
        for channel in (COMMAND, RESET):
            self.controller.subscribe(channel, self.on_answer).set_queue_capacity(500)

    def on_state(self, channel, data):
        state = robot_state_t.decode(data)
        if not self.states or (state.session, state.seq) != (self.states[-1].session, self.states[-1].seq):
            self.states.append(state)
        told = robot_state_t.decode(data)
        self.sensed(told)
        self.controller.publish(channel, told.encode())

    def on_answer(self, channel, data):
        if channel == COMMAND:
            command = velocity_command_t.decode(data)
            if not self.commands or command.seq != self.commands[-1].seq:
                self.commands.append(command)
        self.plant.publish(channel, data)

    def run(self, decisions):
        while len(self.commands) < decisions:
            self.plant.handle_timeout(1)
            self.controller.handle_timeout(1)


class Sensors:
    """What of its place a robot knows."""

    def __init__(self):
        self.last = None  # newest (seq, travel of the belt), and where it has led to
        self.place = [0.0, 0.0]

    def position_unknown(self, state):
        state.position = [0.0, 0.0, 0.0]

    def heading_unknown(self, state):
        """Nor position; what is left of the attitude is where up is."""
        self.position_unknown(state)
        level = quaternion.about((0, 0, 1), math.pi / 2 - quaternion.heading(state.orientation))
        state.orientation = list(quaternion.product(level, state.orientation))

    def all_known(self, state):
        pass

    def reckoned(self, state):
        """Where the belt of the sound crawler would have led it, along the heading."""
        travel, heading = state.actuator_position[RIGHT_CRAWLER], quaternion.heading(state.orientation)
        if self.last and state.seq != self.last[0]:
            step = travel - self.last[1]
            self.place[0] += step * math.cos(heading)
            self.place[1] += step * math.sin(heading)
        self.last = state.seq, travel
        state.position = [*self.place, 0.0]


def drive(folder, run, sensed, selection):
    """[decision][commands of the actuators], and where the robot then is: x, y [m], heading [rad]."""
    with Bus(folder) as bus:
        trained = RunFolder(run)
        common = ["--config", trained.config, "--robot", trained.robot, *settings(*STRAIGHT)]
        bus.start([paths.program("simulator"), *common, "--lcm-url", network.lcm_url()])
        chosen = settings(f"evaluation.selection={selection}")
        evaluate = [*chosen, "--evaluate", trained.policy, "--out", bus.folder / "run"]
        url = network.lcm_url(OTHER_PORT)
        bus.start([paths.program("controller"), *common, *evaluate, "--lcm-url", url])
        relay = Relay(getattr(Sensors(), sensed))
        relay.run(DECISIONS)
        last = relay.states[-1]
        return [[list(each.velocity[:5]) for each in relay.commands[:DECISIONS]], *last.position[:2]]


def trained(folder, config):
    """Of few episodes: what matters here is what a policy looks at."""
    episodes = ("--episodes", 5, "--set", "episode.step_limit=60")
    run_script("train", "--config", ROOT / "config" / config, *episodes, "--out", folder / "trained", "--quiet")
    return str(folder / "trained")


def driven(folder, run, sensed, selection="greedy"):
    (folder / sensed).mkdir()
    return inside(drive, str(folder / sensed), run, sensed, selection)


def test_q_learning_drives_the_same_without_position_and_heading(tmp_path):
    """By chance, so that it does more than the few things that it has learned: Q is the same, to the last bit."""
    run = trained(tmp_path, "paper.ini")
    ways = ("all_known", "position_unknown", "heading_unknown")
    known, *others = (driven(tmp_path, run, way, "boltzmann") for way in ways)
    assert len({tuple(velocities) for velocities in known[0]}) > 10
    assert others == [known, known]


def test_planner_steers_by_the_position_and_bears_a_guess_of_it(tmp_path):
    """It steers by both; in the long run it takes a robot that never gets nearer for stuck."""
    run = trained(tmp_path, "default.ini")
    known, reckoned, unknown = (driven(tmp_path, run, way) for way in ("all_known", "reckoned", "position_unknown"))
    for _, beside, ahead in (known, reckoned, unknown):
        assert ahead > 3 and abs(beside) < 0.5
    assert known[0] != unknown[0] != reckoned[0]  # it does look at where it is
