/* liblimphome: everything. A caller needs controller.h; the rest is what it is made of. */
#ifndef LIMPHOME_LIMPHOME_H
#define LIMPHOME_LIMPHOME_H

#include "limphome/action.h"
#include "limphome/action_values.h"
#include "limphome/boltzmann.h"
#include "limphome/capacity.h"
#include "limphome/controller.h"
#include "limphome/elementary.h"
#include "limphome/episode.h"
#include "limphome/error.h"
#include "limphome/kinematics.h"
#include "limphome/learner.h"
#include "limphome/network.h"
#include "limphome/observation.h"
#include "limphome/random.h"
#include "limphome/reward.h"
#include "limphome/robot.h"
#include "limphome/stability.h"
#include "limphome/vector.h"

#endif
