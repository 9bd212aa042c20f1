// Eigen's types from Bullet's and back.
#pragma once

#include <LinearMath/btTransform.h>

#include <Eigen/Geometry>

namespace limphome {

inline btVector3 to_bullet(const Eigen::Vector3d &v) {
    return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3d to_eigen(const btVector3 &v) {
    return {v.x(), v.y(), v.z()};
}

inline btQuaternion to_bullet(const Eigen::Quaterniond &q) {
    return {q.x(), q.y(), q.z(), q.w()};
}
inline Eigen::Quaterniond to_eigen(const btQuaternion &q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

inline Eigen::Matrix3d to_eigen(const btMatrix3x3 &m) {
    Eigen::Matrix3d result;
    for (int row = 0; row < 3; row++) {
        result.row(row) = to_eigen(m.getRow(row));
    }
    return result;
}

inline btTransform to_bullet(const Eigen::Isometry3d &t) {
    return btTransform(to_bullet(Eigen::Quaterniond(t.linear())), to_bullet(Eigen::Vector3d(t.translation())));
}

}  // namespace limphome
