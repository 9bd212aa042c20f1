/* liblimphome: everything. A caller needs controller.h; the rest is what it is made of. */
#ifndef LIMPHOME_LIMPHOME_H
#define LIMPHOME_LIMPHOME_H

#include "limphome/task/action.h"
#include "limphome/learning/action_values.h"
#include "limphome/learning/boltzmann.h"
#include "limphome/base/capacity.h"
#include "limphome/controller.h"
#include "limphome/base/elementary.h"
#include "limphome/task/episode.h"
#include "limphome/base/error.h"
#include "limphome/body/kinematics.h"
#include "limphome/learning/learner.h"
#include "limphome/learning/network.h"
#include "limphome/task/observation.h"
#include "limphome/base/random.h"
#include "limphome/task/reward.h"
#include "limphome/body/robot.h"
#include "limphome/body/stability.h"
#include "limphome/base/vector.h"

#endif
