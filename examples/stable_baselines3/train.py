"""Trains a learner of Stable-Baselines3 on limphome's task and measures it as ours are measured.

example: .venv/bin/python examples/stable_baselines3/train.py --seed 1

Leaves SEED.zip, the learner, and SEED.json, what it came to, in the folder --out. README.md tells what it needs.
"""

import argparse
import json
import math
import statistics
import time
from pathlib import Path

import gymnasium
import torch
from stable_baselines3 import DQN
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import configure
from stable_baselines3.common.monitor import Monitor

from limphome_lab.gym import ID
from limphome_lab.runfolder import Episode
from limphome_lab.show import learned

TASK = {"episode.step_limit": 200}  # so that a young learner sees new goal lines soon; it is not put back
GREEDY_EPISODES = 50


class Rows(BaseCallback):
    """The episodes of the training, as rows of episodes.csv; ends it when the time is up."""

    def __init__(self, seconds: float) -> None:
        super().__init__()
        self.end = time.monotonic() + seconds
        self.rows: list[Episode] = []

    def _on_step(self) -> bool:
        info = self.locals["infos"][0]
        if "outcome" in info:
            self.rows.append(row(info))
        return time.monotonic() < self.end


def row(info: dict) -> Episode:
    """Of the last step of an episode. What is summed over one is not needed here."""
    nan = float("nan")
    return Episode(
        episode=int(info["episode_number"]),
        outcome=info["outcome"],
        steps=int(info["step"]),
        duration_s=info["duration"],
        reward=nan,
        reward_motion=nan,
        reward_goal=nan,
        reward_stability=nan,
        reward_tumble=nan,
        lateral_error_m=info["lateral_error"],
        heading_change_rad=info["heading_change"],
        temperature=nan,
    )


def drive(model: DQN, env: gymnasium.Env, episodes: int) -> list[Episode]:
    """Greedily, without learning."""
    rows = []
    observation, _ = env.reset(options={"put_back": True})
    while len(rows) < episodes:
        action, _ = model.predict(observation, deterministic=True)
        observation, _, terminated, truncated, info = env.step(int(action))
        if terminated or truncated:
            rows.append(row(info))
            observation, _ = env.reset()
    return rows


def summary(rows: list[Episode]) -> dict:
    return {
        "goals": sum(each.outcome == "goal" for each in rows) / len(rows),
        "tumbles": sum(each.outcome == "tumble" for each in rows),
        "duration_s": statistics.median(each.duration_s for each in rows),
        "lateral_error_m": learned.median_size(rows, "lateral_error_m"),
        "heading_change_deg": learned.median_size(rows, "heading_change_rad") * 57.29578,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--steps", type=int, default=60_000, help="decisions to learn from; default 60000")
    parser.add_argument("--minutes", type=float, default=math.inf, help="after which it ends in any case")
    parser.add_argument("--out", type=Path, default=Path("runs/stable_baselines3"))
    args = parser.parse_args()
    torch.set_num_threads(1)
    args.out.mkdir(parents=True, exist_ok=True)

    env = gymnasium.make(ID, line=True, set=TASK)
    model = DQN(
        "MlpPolicy",
        Monitor(env),
        seed=args.seed,
        learning_rate=5e-4,
        gamma=0.97,
        buffer_size=200_000,
        batch_size=128,
        learning_starts=1_000,
        train_freq=4,
        gradient_steps=2,
        target_update_interval=500,
        exploration_fraction=0.2,
        exploration_final_eps=0.02,
        policy_kwargs={"net_arch": [128, 128]},
        device="cpu",
    )
    model.set_logger(configure(None, ["log"]))
    rows = Rows(60 * args.minutes)
    begun = time.monotonic()
    model.learn(args.steps, callback=rows)
    seconds = time.monotonic() - begun
    result = {
        "seed": args.seed,
        "steps": model.num_timesteps,
        "minutes": round(seconds / 60, 1),
        "episodes": len(rows.rows),
        "learned_at": learned.learned_at(rows.rows),
        "held": learned.held(rows.rows),
        "robot_minutes": learned.robot_minutes(rows.rows),
        "training_end": summary(rows.rows[-learned.LAST :]),
        "greedy": summary(drive(model, env, GREEDY_EPISODES)),
    }
    env.close()
    model.save(args.out / f"{args.seed}.zip")
    (args.out / f"{args.seed}.json").write_text(json.dumps(result, indent=2) + "\n")
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
