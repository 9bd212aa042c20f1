"""The task for learners of others: a `gymnasium.Env` on the simulator, rewarded and ended as our own learners are.

    import gymnasium
    import limphome_lab.gym

    env = gymnasium.make("limphome/LimpHome-v0", set={"failure.actuator": "right_crawler"})

Importing this registers `limphome/LimpHome-v0`, whose keywords are those of `LimpHome`; `gymnasium.make_vec` makes
`LimpHomeVector` of it, unless told otherwise.
"""

import gymnasium

from limphome_lab.gym.limp_home import LimpHome
from limphome_lab.gym.vector import LimpHomeVector

__all__ = ["ID", "LimpHome", "LimpHomeVector"]

ID = "limphome/LimpHome-v0"

# told by name, so that a specification can be written down
gymnasium.register(
    ID,
    entry_point="limphome_lab.gym.limp_home:LimpHome",
    vector_entry_point="limphome_lab.gym.vector:LimpHomeVector",
)
