/* liblimphome: everything. A caller needs controller.h; the rest is what it is made of. */
#ifndef LIMPHOME_LIMPHOME_H
#define LIMPHOME_LIMPHOME_H

#include "limphome/base/capacity.h"
#include "limphome/base/elementary.h"
#include "limphome/base/error.h"
#include "limphome/base/random.h"
#include "limphome/base/vector.h"
#include "limphome/body/kinematics.h"
#include "limphome/body/quasi_static.h"
#include "limphome/body/rest.h"
#include "limphome/body/robot.h"
#include "limphome/body/stability.h"
#include "limphome/controller.h"
#include "limphome/learning/action_values.h"
#include "limphome/learning/boltzmann.h"
#include "limphome/learning/choice.h"
#include "limphome/learning/learner.h"
#include "limphome/learning/motion_model.h"
#include "limphome/learning/network.h"
#include "limphome/learning/planned.h"
#include "limphome/learning/planner.h"
#include "limphome/learning/posture_values.h"
#include "limphome/learning/q_learning.h"
#include "limphome/task/action.h"
#include "limphome/task/episode.h"
#include "limphome/task/observation.h"
#include "limphome/task/path.h"
#include "limphome/task/reward.h"
#include "limphome/task/task.h"

#endif
