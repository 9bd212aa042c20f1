"""Motor controllers and an IMU on a CAN bus, simulated: motors.py [--interface socketcan|slcan] CHANNEL

Each motor obeys the newest velocity, within its acceleration, and stops where none has come for --silence. README.md
has the frames. SIGUSR1 presses the emergency stop, and releases it the next time; SIGUSR2 has the last motor fail.
"""

import argparse
import math
import signal
import struct
import time

import can

MEASUREMENT, VELOCITY, HEARTBEAT, NODE = 0x180, 0x200, 0x700, 0x7F  # identifiers: what it is, plus the node
IMU = 16
OBEYS, FAILED, WEAK, NO_POWER = range(4)
CYCLE_S = 0.02
HEARTBEAT_CYCLES = 5
ACCELERATION = 2.0  # [m/s^2, rad/s^2]
INERTIA, FRICTION = 200.0, 300.0  # of what a motor moves: [N*m per m/s^2 or rad/s^2], [N*m]
TRACK_WIDTH = 0.95  # [m]


class Motor:
    def __init__(self, position, condition=OBEYS):
        self.position = position  # [m] or [rad]
        self.condition = condition
        self.velocity = self.wanted = self.torque = 0.0
        self.heard = -math.inf  # when a velocity came last [s]

    def advance(self, seconds, silence):
        fresh = time.monotonic() - self.heard < silence
        wanted = self.wanted if fresh and self.condition in (OBEYS, WEAK) else 0.0
        before = self.velocity
        most = ACCELERATION * seconds
        self.velocity += min(max(wanted - before, -most), most)
        self.position += self.velocity * seconds
        pushed = FRICTION * ((self.velocity > 0) - (self.velocity < 0))
        self.torque = INERTIA * (self.velocity - before) / seconds + pushed


class Nodes:
    def __init__(self, bus, motors, silence):
        self.bus, self.motors, self.silence = bus, motors, silence
        self.heading = math.pi / 2  # [rad] world x to body x: it faces +y
        self.cycle = 0
        self.stopped = False  # the emergency stop is pressed

    def hear(self, until):
        """Takes velocities until then [s, monotonic]."""
        while (left := until - time.monotonic()) > 0:
            frame = self.bus.recv(left)
            number = frame.arbitration_id & NODE if frame else 0
            if frame and frame.arbitration_id & ~NODE == VELOCITY and frame.dlc == 2 and number <= len(self.motors):
                motor = self.motors[number - 1]
                motor.wanted = struct.unpack("<h", frame.data)[0] / 1000
                motor.heard = time.monotonic()

    def advance(self):
        for motor in self.motors:
            if not self.stopped:
                motor.advance(CYCLE_S, self.silence)
            else:
                motor.velocity = motor.wanted = motor.torque = 0.0  # brakes fall in
        left, right = self.motors[:2]
        self.heading += (right.velocity - left.velocity) / TRACK_WIDTH * CYCLE_S

    def tell(self):
        for number, motor in enumerate(self.motors, 1):
            numbers = round(motor.position * 1e4), round(motor.velocity * 1e3), round(motor.torque)
            self.send(MEASUREMENT + number, struct.pack("<ihh", *numbers))
        turn = math.cos(self.heading / 2), 0.0, 0.0, math.sin(self.heading / 2)
        self.send(MEASUREMENT + IMU, struct.pack("<4h", *(round(32767 * part) for part in turn)))
        if self.cycle % HEARTBEAT_CYCLES == 0:
            for number, motor in enumerate(self.motors, 1):
                self.send(HEARTBEAT + number, bytes([NO_POWER if self.stopped else motor.condition]))
            self.send(HEARTBEAT + IMU, bytes([OBEYS]))
        self.cycle += 1

    def send(self, identifier, data):
        self.bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))

    def press_or_release(self, *_):
        self.stopped = not self.stopped
        print("emergency stop", "pressed" if self.stopped else "released", flush=True)

    def fail(self, *_):
        self.motors[-1].condition = FAILED
        print(f"motor {len(self.motors)} fails", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("channel", help="vcan0, say, or the serial line of an adapter")
    parser.add_argument("--interface", choices=("socketcan", "slcan"), default="socketcan")
    parser.add_argument("--home", default="0,0,0,0.6,-1.5", help="position of each motor [m, rad]; default %(default)s")
    parser.add_argument(
        "--failed",
        action="append",
        type=int,
        default=[],
        metavar="MOTOR",
        help="from 1, that does not obey; repeatable",
    )
    parser.add_argument("--silence", type=float, default=0.1, help="without a velocity a motor stops after this [s]")
    args = parser.parse_args()
    options = {"sleep_after_open": 0, "bitrate": 500_000} if args.interface == "slcan" else {}
    motors = [
        Motor(home, FAILED if n in args.failed else OBEYS) for n, home in enumerate(map(float, args.home.split(",")), 1)
    ]
    with can.Bus(interface=args.interface, channel=args.channel, **options) as bus:
        nodes = Nodes(bus, motors, args.silence)
        signal.signal(signal.SIGUSR1, nodes.press_or_release)
        signal.signal(signal.SIGUSR2, nodes.fail)
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        print("running", flush=True)
        due = time.monotonic()
        try:
            while True:
                due = max(due + CYCLE_S, time.monotonic())  # after a stall it does not hurry
                nodes.hear(due)
                nodes.advance()
                nodes.tell()
        except KeyboardInterrupt:
            pass


if __name__ == "__main__":
    main()
