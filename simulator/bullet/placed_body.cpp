#include "bullet/placed_body.h"

namespace limphome {

void place_bodies(const RobotModel &model, const Eigen::Isometry3d &base, const double *angles,
                  std::vector<PlacedBody> &bodies) {
    for (std::size_t i = 0; i < bodies.size(); i++) {
        const Body &body = model.bodies[i];
        PlacedBody &placed = bodies[i];
        placed.parent = body.parent;
        placed.mass = body.mass;
        placed.angle = i > 0 ? angles[i - 1] : 0;
        if (body.parent < 0) {
            placed.axes = base.linear();
            placed.origin = base.translation();
        } else {
            const PlacedBody &parent = bodies[static_cast<std::size_t>(body.parent)];
            const Eigen::Matrix3d at_zero = parent.axes.lazyProduct(body.joint.linear());
            placed.axes = at_zero.lazyProduct(Eigen::AngleAxisd(placed.angle, body.axis).toRotationMatrix());
            placed.origin = parent.point(body.joint.translation());
        }
        placed.axis = placed.axes.lazyProduct(body.axis);
        placed.centre = placed.point(body.centre);
        const Eigen::Matrix3d turned = placed.axes.lazyProduct(body.inertia);
        placed.inertia = turned.lazyProduct(placed.axes.transpose());
    }
}

}  // namespace limphome
