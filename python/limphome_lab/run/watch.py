"""Which of two processes is stuck, and how, when a run does not get on."""

import sys
import time
from pathlib import Path

QUIET_S = 10.0  # without an episode, before the processes are looked at
LISTEN_S = 3.0  # of the status that each tells every second, before something is said
AGAIN_S = 60.0  # between two lines that say the same
POLL_MOST_S = 1.0  # counted between two looks: a process that was stopped has not waited

STATES = {
    "T": "is stopped by a signal; SIGCONT lets it go on",
    "t": "is stopped by a debugger",
    "D": "waits for a disk or another device",
    "Z": "has ended",
}
REASONS = {  # of status_t
    "NO_PLANT": "hears no plant",
    "PLANT_SILENT": "waits for the plant, which has fallen silent",
    "NOT_OBEYED": "is not obeyed: the plant obeys another controller",
    "INVALID_STATES": "gets states that are invalid",
    "NOT_ARMED": "waits for the plant to be armed",
    "TUMBLED": "waits for the robot, which has tumbled, to be righted",
    "FLOODED": "gets more messages than it can look at",
    "NO_CONTROLLER": "waits for a controller",
    "NOT_YET_ARMED": "is not armed yet",
    "CONTROLLER_SILENT": "is not armed: the controller has been silent",
    "OPERATOR_SILENT": "is not armed: the operator has been silent",
    "MACHINE_FAILED": "is not armed: the machine has failed",
    "BY_OPERATOR": "was disarmed by the operator",
    "PACED": "is held up by a person at a viewer",
}


class Watch:
    """Look often. It listens to the processes only where no episode has ended for a while: that costs time. `url` None:
    there is nothing to listen to, and only that a process may not run is told."""

    def __init__(self, url, tell=None):
        self.url = url
        self.tell = tell or (lambda text: print(text, file=sys.stderr))
        self._looked = time.monotonic()
        self._listener = None
        self._said, self._said_at = None, float("-inf")
        self.progressed()

    def progressed(self):
        self._quiet_s = 0.0
        self._listener = None

    def look(self, children):
        now = time.monotonic()
        self._quiet_s += min(now - self._looked, POLL_MOST_S)
        self._looked = now
        if self._quiet_s < QUIET_S:
            return
        if self.url is None:
            self._say(process_troubles(children), now)
            return
        self._listener = self._listener or Listener(self.url)
        self._listener.listen()
        if self._listener.decides():
            self.progressed()
        elif self._quiet_s >= QUIET_S + LISTEN_S:
            self._say(explain(children, self._listener.statuses), now)

    def _say(self, text, now):
        if text and (text != self._said or now - self._said_at >= AGAIN_S):
            self.tell(f"no progress for {self._quiet_s:.0f} s: {text}")
            self._said, self._said_at = text, now


class Listener:
    """The newest LIMPHOME_STATUS of each process."""

    def __init__(self, url):
        import lcm  # lcm is there once all is set up, and --help before

        from limphome_lab.channels import STATUS

        self.statuses = {}
        self._before = None
        self._bus = lcm.LCM(url)
        self._bus.subscribe(STATUS, self._receive)

    def _receive(self, _channel, data):
        from limphome import status_t

        try:
            status = status_t.decode(data)
        except ValueError:
            return
        name = {status_t.PLANT: "simulator", status_t.CONTROLLER: "controller"}.get(status.process)
        if name == "controller" and self._before is None:
            self._before = status.decisions
        self.statuses[name] = status

    def listen(self):
        while self._bus.handle_timeout(0):
            pass

    def decides(self):
        """Whether the controller has decided on something since it was first heard."""
        return "controller" in self.statuses and self.statuses["controller"].decisions > self._before


def explain(children, statuses):
    """What is to be said of the children, the culprit alone where there is one."""
    return process_troubles(children) or _words(
        {child.name: status_trouble(statuses.get(child.name)) for child in children}
    )


def process_troubles(children):
    """The same as far as the kernel knows; "" where all may run."""
    return _words({child.name: process_trouble(child.process.pid) for child in children})


def _words(troubles):
    return ", ".join(f"limphome-{name} {trouble}" for name, trouble in troubles.items() if trouble)


def process_trouble(pid):
    """Of a process as the kernel sees it; None where it may run."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        state = "Z"
    return STATES.get(state)


def status_trouble(status):
    """Of a process by what it last told."""
    if status is None:
        return "is silent"
    for name, words in REASONS.items():
        if getattr(status, "reason", 0) and getattr(status, name, None) == status.reason:
            return words
    waiting = status.condition == status.WAITING
    return "waits for the other" if waiting else "runs, but nothing comes of it"
