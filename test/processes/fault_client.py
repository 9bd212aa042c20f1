"""A controller of a few lines: python fault_client.py URL VELOCITIES COMMAND...

Starts COMMAND, a limphome-simulator, asks for a reset of each session that began by itself and answers the states of
all others with VELOCITIES (JSON, a list of commands) one after the other, then ends it. Prints JSON: those sessions
with the number of their states, where each began, whether all values were finite, the newest count of faults with the
session the plant told of, and the simulator's exit code.
"""

import json
import math
import subprocess
import sys

import lcm

from limphome import reset_request_t, robot_state_t, status_t, velocity_command_t
from limphome_lab.channels import COMMAND, RESET, STATE, STATUS

SENDER = 1


class Client:
    def __init__(self, url, velocities):
        self.lcm = lcm.LCM(url)
        self.lcm.subscribe(STATE, self._on_state)
        self.lcm.subscribe(STATUS, self._on_status)
        self.velocities = velocities
        self.answers = {}  # (session, seq) -> command
        self.sessions = {}  # session -> number of states
        self.first_positions = []
        self.all_finite = True
        self.faults, self.fault_session = 0, None
        self.done = False

    def _on_state(self, _channel, data):
        state = robot_state_t.decode(data)
        values = [
            *state.position,
            *state.orientation,
            *state.actuator_position,
            *state.actuator_velocity,
            *state.actuator_effort,
        ]
        self.all_finite = self.all_finite and all(map(math.isfinite, values))
        if state.reset_sender != SENDER:
            self._ask_for_reset(state)
            return
        key = (state.session, state.seq)
        if key not in self.answers:
            if state.session not in self.sessions:
                self.first_positions.append(state.position)
            self.sessions[state.session] = self.sessions.get(state.session, 0) + 1
            if not self.velocities:
                self.done = True
                return
            self.answers[key] = self.velocities.pop(0)
        command = velocity_command_t()
        command.session, command.seq = key
        command.sender, command.num_actuators = SENDER, state.num_actuators
        command.velocity[: len(self.answers[key])] = self.answers[key]
        self.lcm.publish(COMMAND, command.encode())

    def _ask_for_reset(self, state):
        request = reset_request_t()
        request.session, request.seq, request.sender, request.nonce = state.session, state.seq, SENDER, 1
        self.lcm.publish(RESET, request.encode())

    def _on_status(self, _channel, data):
        status = status_t.decode(data)
        self.faults = max(self.faults, status.faults)
        if status.condition == status_t.FAULT:
            self.fault_session = status.session


def main():
    url, velocities, command = sys.argv[1], json.loads(sys.argv[2]), sys.argv[3:]
    client = Client(url, velocities)
    simulator = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        while simulator.poll() is None and not client.done:
            client.lcm.handle_timeout(100)
        simulator.terminate()
        simulator.wait(20)
        while client.lcm.handle_timeout(100):
            pass
    finally:
        simulator.kill()
    print(
        json.dumps(
            {
                "sessions": list(client.sessions.items()),
                "first_positions": client.first_positions,
                "all_finite": client.all_finite,
                "faults": client.faults,
                "fault_session": client.fault_session,
                "exit_code": simulator.wait(),
            }
        )
    )


if __name__ == "__main__":
    main()
