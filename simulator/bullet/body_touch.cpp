#include "bullet/body_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bullet/convert.h"
#include "bullet/meeting.h"

namespace limphome {
namespace {

// Farthest that anything carried by the joint of `body` can get from its axis, however the joints beyond it turn.
double farthest_carried(const RobotModel &model, int body) {
    double farthest = 0;
    for (const Solid &solid : model.solids) {
        double reach = Eigen::Vector3d(solid.shape.centre).norm() + robot_solid_reach(&solid.shape);
        int at = solid.body;
        for (; at > body; at = model.bodies[static_cast<std::size_t>(at)].parent) {
            reach += model.bodies[static_cast<std::size_t>(at)].joint.translation().norm();
        }
        farthest = at == body ? std::max(farthest, reach) : farthest;
    }
    return farthest;
}

robot_solid in_world(const Robot &robot, const Solid &solid) {
    const Eigen::Isometry3d frame = robot.body_frame(solid.body);
    const Eigen::Quaterniond q(frame.linear());
    robot_pose pose{{}, {q.w(), q.x(), q.y(), q.z()}};
    Eigen::Map<Eigen::Vector3d>(pose.position) = frame.translation();
    return robot_solid_placed(&solid.shape, &pose);
}

}  // namespace

BodyTouches::BodyTouches(const Robot &robot) {
    const RobotModel &model = robot.model();
    for (std::size_t i = 0; i < model.solids.size(); i++) {
        for (std::size_t j = i + 1; j < model.solids.size(); j++) {
            const auto a = static_cast<std::size_t>(model.solids[i].body);
            const auto b = static_cast<std::size_t>(model.solids[j].body);
            if (model.may_meet[a][b]) {
                pairs_.push_back({i, j});
            }
        }
    }
    for (std::size_t a = 0; a < model.actuators.size(); a++) {
        const bool is_joint = a >= model.crawlers.size();
        reach_.push_back(is_joint ? farthest_carried(model, static_cast<int>(a) + 1) : 0);
        angles_.push_back(robot.bodies()[a + 1].angle);
    }
}

void BodyTouches::find(const Robot &robot, std::vector<Touch> &touches) {
    for (std::size_t a = 0; a < angles_.size(); a++) {
        const double angle = robot.bodies()[a + 1].angle;
        gone_ += reach_[a] * std::abs(angle - angles_[a]);
        angles_[a] = angle;
    }
    if (gone_ < due_) {
        return;
    }
    due_ = std::numeric_limits<double>::infinity();
    for (Pair &pair : pairs_) {
        if (gone_ >= pair.due) {
            look(robot, pair, touches);
        }
        due_ = std::min(due_, pair.due);
    }
}

void BodyTouches::look(const Robot &robot, Pair &pair, std::vector<Touch> &touches) const {
    const std::vector<Solid> &solids = robot.model().solids;
    const robot_solid a = in_world(robot, solids[pair.first]), b = in_world(robot, solids[pair.second]);
    const robot_gap gap = robot_solid_gap(&a, &b);
    pair.due = gone_ + std::max(gap.distance, 0.0);
    if (gap.distance >= 0) {
        return;
    }
    const int first = robot.first_solid();
    const Meeting meeting = meet(a, b, gap);
    for (int i = 0; i < meeting.count; i++) {
        const MeetingPoint &at = meeting.points[static_cast<std::size_t>(i)];
        touches.push_back({first + static_cast<int>(pair.first), at.point, meeting.normal, at.depth,
                           first + static_cast<int>(pair.second)});
    }
}

}  // namespace limphome
