// Eigen's matrix form, single precision: ||x - mu||^2 of all actions and units as one matrix product.
#include <Eigen/Dense>

#include "decision.h"

namespace {

using Eigen::ArrayXf;
using Eigen::MatrixXf;
using Eigen::VectorXf;

const problem *given;
lh_random generator;
MatrixXf actions;  // inputs of the joint actions [num_controlled x num_actions]
MatrixXf centre;   // [inputs x units]
ArrayXf weight, width;
VectorXf q;
int32_t last_action;

void begin(const problem *p) {
    given = p;
    generator = p->learner.random;
    last_action = 0;
    const int32_t inputs = p->num_states + p->num_controlled;
    actions.resize(p->num_controlled, p->learner.num_actions);
    for (int32_t a = 0; a < p->learner.num_actions; a++) {
        for (int32_t k = 0, rest = a; k < p->num_controlled; k++, rest /= 3) {
            actions(k, a) = 0.5f * static_cast<float>(rest % 3);
        }
    }
    weight = Eigen::Map<const ArrayXf>(p->learner.network.weight, UNITS);
    width = Eigen::Map<const ArrayXf>(p->learner.network.width, UNITS);
    centre.resize(inputs, UNITS);
    for (int32_t i = 0; i < inputs; i++) {
        centre.row(i) = Eigen::Map<const Eigen::RowVectorXf>(p->learner.network.centre[i], UNITS);
    }
}

VectorXf states_of(int32_t k) {
    return Eigen::Map<const VectorXf>(given->states[k % SITUATIONS], given->num_states);
}

float evaluate_all(int32_t k) {
    const VectorXf states = states_of(k);
    const auto ours = centre.topRows(given->num_states);
    const auto theirs = centre.bottomRows(given->num_controlled);
    // ||x - mu||^2 = (distance of the states) + |a|^2 - 2 a.mu + |mu|^2
    const Eigen::RowVectorXf fixed = (ours.colwise() - states).colwise().squaredNorm() + theirs.colwise().squaredNorm();
    MatrixXf distance = actions.transpose() * (-2.0f * theirs);
    distance.colwise() += actions.colwise().squaredNorm().transpose();
    distance.rowwise() += fixed;
    const Eigen::RowVectorXf precision = (1.0f / width.square()).matrix().transpose();
    q.noalias() = (-(distance.array().rowwise() * precision.array())).exp().matrix() * weight.matrix();
    return q.maxCoeff();
}

int32_t choose(float q_max) {
    const ArrayXf likelihood = ((q.array() - q_max) / TEMPERATURE).exp();
    const float target = lh_random_uniform(&generator) * likelihood.sum();
    int32_t chosen = 0;
    for (float sum = likelihood[0]; sum <= target && chosen + 1 < likelihood.size(); sum += likelihood[chosen]) {
        chosen++;
    }
    return chosen;
}

void learn(const VectorXf &x, float target) {
    const lh_q_learning_config &config = given->learner.config;
    const MatrixXf difference = (-centre).colwise() + x;
    const ArrayXf distance = difference.colwise().squaredNorm().transpose().array();
    const ArrayXf phi = (-distance / width.square()).exp();
    const float step = config.learning_rate * (target - (weight * phi).sum());
    const ArrayXf pull = 2.0f * step * weight * phi / width.square();
    weight += config.network.rate_weight * step * phi;
    width += config.network.rate_width * pull * distance / width;
    centre += config.network.rate_centre * (difference * pull.matrix().asDiagonal());
}

int32_t decide(int32_t k) {
    const float q_max = evaluate_all(k);
    const int32_t action = choose(q_max);
    VectorXf x(given->num_states + given->num_controlled);
    x << states_of(k + SITUATIONS - 1), actions.col(last_action);
    learn(x, reward_of(k) + given->learner.config.discount_rate * q_max);
    last_action = action;
    return action;
}

}  // namespace

const method eigen_method = {begin, decide};
