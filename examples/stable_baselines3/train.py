"""Trains DQN of Stable-Baselines3 on limphome's task and measures it as our own learners are measured.

Leaves in --out, for each seed, SEED.zip, the learner; SEED.csv, its episodes as a run folder has them; and SEED.json,
what it came to. README.md beside this tells what it needs.
"""

import argparse
import csv
import json
import math
import sys
import time
from dataclasses import astuple, fields
from pathlib import Path

import gymnasium
import torch
from stable_baselines3 import DQN
from stable_baselines3.common.callbacks import BaseCallback

from limphome_lab.gym import ID
from limphome_lab.runfolder import Episode
from limphome_lab.show import learned

TASK = {"episode.step_limit": 200}  # a young learner meets new goal lines sooner; it is not put back for it
GREEDY_EPISODES = 50
REWARDS = ("reward_motion", "reward_goal", "reward_stability", "reward_tumble")


class Rows(gymnasium.Wrapper):
    """Keeps the episodes as rows of episodes.csv."""

    def __init__(self, env: gymnasium.Env) -> None:
        super().__init__(env)
        self.rows: list[Episode] = []

    def reset(self, **options):
        self._total = dict.fromkeys(REWARDS, 0.0)
        return super().reset(**options)

    def step(self, action):
        *told, info = super().step(action)
        for name in REWARDS:
            self._total[name] += info[name]
        if "outcome" in info:
            self.rows.append(
                Episode(
                    episode=len(self.rows) + 1,
                    outcome=info["outcome"],
                    steps=int(info["step"]),
                    duration_s=info["duration"],
                    reward=sum(self._total.values()),
                    **self._total,
                    lateral_error_m=info["lateral_error"],
                    heading_change_rad=info["heading_change"],
                    temperature=0.0,
                )
            )
        return *told, info


class Progress(BaseCallback):
    """Tells now and then how far it is."""

    def __init__(self, rows: list[Episode], steps: int) -> None:
        super().__init__()
        self._rows, self._steps = rows, steps

    def _on_step(self) -> bool:
        if self.num_timesteps % 1000 == 0:
            goals = sum(each.outcome == "goal" for each in self._rows[-learned.WINDOW :])
            print(
                f"{self.num_timesteps}/{self._steps} decisions, {len(self._rows)} episodes, "
                f"{goals} of the last {learned.WINDOW} at the goal",
                file=sys.stderr,
            )
        return True


def drive(model: DQN, env: Rows, episodes: int) -> list[Episode]:
    """Greedily, without learning; begins in the initial pose."""
    observation, _ = env.reset(options={"put_back": True})
    before = len(env.rows)
    while len(env.rows) < before + episodes:
        action, _ = model.predict(observation, deterministic=True)
        observation, _, terminated, truncated, _ = env.step(int(action))
        if terminated or truncated:
            observation, _ = env.reset()
    return env.rows[before:]


def summary(rows: list[Episode]) -> dict[str, float]:
    return {
        "goals": sum(each.outcome == "goal" for each in rows),
        "of": len(rows),
        "tumbles": sum(each.outcome == "tumble" for each in rows),
        "duration_s": learned.median_size(rows, "duration_s"),
        "lateral_error_m": learned.median_size(rows, "lateral_error_m"),
        "heading_change_deg": math.degrees(learned.median_size(rows, "heading_change_rad")),
    }


def write(file: Path, rows: list[Episode]) -> None:
    with open(file, "w", newline="") as table:
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(field.name for field in fields(Episode))
        writer.writerows(map(astuple, rows))


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n")[0], epilog="example: python examples/stable_baselines3/train.py --seed 1"
    )
    parser.add_argument("--seed", type=int, default=1, help="of learner and simulator; default 1")
    parser.add_argument("--steps", type=int, default=25_000, help="decisions to learn from; default 25000")
    parser.add_argument("--out", type=Path, default=Path("runs/stable_baselines3"), help="default %(default)s")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(1)

    env = Rows(gymnasium.make(ID, line=True, set=TASK))
    model = DQN(
        "MlpPolicy",
        env,
        seed=args.seed,
        learning_rate=5e-4,
        gamma=0.97,
        buffer_size=200_000,
        batch_size=128,
        learning_starts=1_000,
        gradient_steps=2,
        target_update_interval=500,
        exploration_fraction=0.2,
        exploration_final_eps=0.02,
        policy_kwargs={"net_arch": [128, 128]},
        device="cpu",
    )
    begun = time.monotonic()
    model.learn(args.steps, callback=Progress(env.rows, args.steps))
    minutes = (time.monotonic() - begun) / 60
    rows = list(env.rows)
    result = {
        "seed": args.seed,
        "decisions": args.steps,
        "minutes": round(minutes, 1),
        "episodes": len(rows),
        "learned_at": learned.learned_at(rows),
        "held": learned.held(rows),
        "robot_minutes": learned.robot_minutes(rows),
        "last": summary(rows[-learned.LAST :]),
        "greedy": summary(drive(model, env, GREEDY_EPISODES)),
    }
    env.close()
    model.save(args.out / f"{args.seed}.zip")
    write(args.out / f"{args.seed}.csv", rows)
    text = json.dumps(result, indent=2)
    (args.out / f"{args.seed}.json").write_text(text + "\n")
    print(text)


if __name__ == "__main__":
    main()
