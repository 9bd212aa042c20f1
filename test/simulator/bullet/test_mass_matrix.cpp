#include "bullet/mass_matrix.h"

#include <gtest/gtest.h>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

// Bullet computes what one column of the inverse is, by another way (articulated bodies).
TEST(MassMatrix, InvertsWhatBulletMakesOfUnitForces) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.2}, 3);
    btMultiBody &multibody = world.robot().multibody();
    const int dofs = 6 + multibody.getNumDofs();
    const GeneralMatrix mass = mass_matrix(world.robot().bodies());
    EXPECT_LT((mass - mass.transpose()).norm(), 1e-9);

    btAlignedObjectArray<btScalar> numbers;
    btAlignedObjectArray<btVector3> vectors;
    btAlignedObjectArray<btMatrix3x3> matrices;
    multibody.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, numbers, vectors, matrices, false, false, false);
    for (int dof = 0; dof < dofs; dof++) {
        const GeneralVector unit = GeneralVector::Unit(dof);
        GeneralVector response = GeneralVector::Zero();
        multibody.calcAccelerationDeltasMultiDof(unit.data(), response.data(), numbers, vectors);
        EXPECT_LT((mass * response - unit).norm(), 1e-9) << "dof " << dof;
    }
}

TEST(MassMatrix, RigidInverseInvertsTheBaseBlock) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.2}, 3);
    const GeneralMatrix mass = mass_matrix(world.robot().bodies());
    const GeneralMatrix inverse = rigid_inverse(mass);
    const Eigen::Matrix<double, 6, 6> product = inverse.topLeftCorner<6, 6>() * mass.topLeftCorner<6, 6>();
    EXPECT_LT((product - Eigen::Matrix<double, 6, 6>::Identity()).norm(), 1e-9);
    EXPECT_EQ(inverse.bottomRows<max_actuators>().norm(), 0);
}

}  // namespace
}  // namespace limphome
