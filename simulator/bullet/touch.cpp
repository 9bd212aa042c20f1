#include "bullet/touch.h"

#include <algorithm>
#include <cmath>

namespace limphome {
namespace {

constexpr int arc_samples = 13;       // of a rounded end
constexpr double arc = 1.5 * M_PI;    // of the circle that is searched [rad]
constexpr int run_samples = 7;        // of the flat run of a belt
constexpr int most_refinements = 30;  // each at least halves the interval
constexpr double fine = 1e-9;         // share of the interval between samples

void add_by_shape(std::vector<Touch> &touches, const Touch &touch) {
    const auto place = std::upper_bound(touches.begin(), touches.end(), touch,
                                        [](const Touch &a, const Touch &b) { return a.shape < b.shape; });
    touches.insert(place, touch);
}

// Curve on the robot: point and derivative at a parameter.
struct CurvePoint {
    Eigen::Vector3d point;
    Eigen::Vector3d rate;
};

// A point of the curve against the ground.
struct Sample {
    double parameter;
    Eigen::Vector3d point;
    Clearance clearance;
    double slope;  // of the distance over the parameter
};

class Search {
   public:
    Search(const Ground &ground, int piece, std::vector<Touch> &touches)
        : ground_(ground), piece_(piece), touches_(touches) {}

    Clearance clearance(const Eigen::Vector3d &point) const { return ground_.clearance(point, piece_); }

    void add(int shape, const Eigen::Vector3d &point, const Clearance &clearance) {
        if (clearance.distance < touch_reach) {
            const Eigen::Vector3d middle = point - 0.5 * clearance.distance * clearance.normal;
            add_by_shape(touches_, {shape, middle, clearance.normal, -clearance.distance});
        }
    }

    // Adds the points of the curve that are nearer to the ground than those beside them.
    template <typename Curve>
    void add_minima(int shape, const Curve &curve, double begin, double end, int samples) {
        Sample previous = sample(curve, begin);
        for (int i = 1; i < samples; i++) {
            const Sample next = sample(curve, begin + (end - begin) * i / (samples - 1));
            const double between = (next.point - previous.point).norm();
            if (previous.slope < 0 && next.slope >= 0 && previous.clearance.distance < touch_reach + between) {
                const Sample lowest = refine(curve, previous, next);
                add(shape, lowest.point, lowest.clearance);
            }
            previous = next;
        }
    }

   private:
    template <typename Curve>
    Sample sample(const Curve &curve, double parameter) const {
        const CurvePoint at = curve(parameter);
        const Clearance free = clearance(at.point);
        return {parameter, at.point, free, free.normal.dot(at.rate)};
    }

    // Where the slope changes its sign: by secants, and by halving where those do not help.
    template <typename Curve>
    Sample refine(const Curve &curve, Sample low, Sample high) const {
        const double enough = fine * (high.parameter - low.parameter);
        Sample best = low.clearance.distance < high.clearance.distance ? low : high;
        for (int i = 0; i < most_refinements && high.parameter - low.parameter > enough; i++) {
            const double secant = low.slope / (low.slope - high.slope);
            const double share = i % 3 == 2 ? 0.5 : secant;
            best = sample(curve, low.parameter + share * (high.parameter - low.parameter));
            if (std::abs(best.slope) < fine) {
                break;
            }
            (best.slope < 0 ? low : high) = best;
        }
        return best;
    }

    const Ground &ground_;
    int piece_;
    std::vector<Touch> &touches_;
};

// A circle about `axis`; `radius` above 0.
void touch_rim(Search &search, int shape, const Eigen::Vector3d &centre, const Eigen::Vector3d &axis, double radius) {
    const Clearance middle = search.clearance(centre);
    const Eigen::Vector3d down = axis.dot(middle.normal) * axis - middle.normal;
    if (middle.distance > radius + touch_reach || down.squaredNorm() < 1e-6) {  // far, or lying flat
        return;
    }
    const Eigen::Vector3d start = radius * down.normalized(), across = axis.cross(start);
    search.add_minima(
        shape,
        [&](double angle) -> CurvePoint {
            const double c = std::cos(angle), s = std::sin(angle);
            return {centre + c * start + s * across, c * across - s * start};
        },
        -0.5 * arc, 0.5 * arc, arc_samples);
}

void touch_crawlers(Search &search, const Robot &robot) {
    const Eigen::Isometry3d pose = robot.pose();
    for (std::size_t i = 0; i < robot.rims().size(); i++) {
        const Rim &rim = robot.rims()[i];
        const int shape = static_cast<int>(i);
        const Eigen::Vector3d centre = pose * rim.centre, axis = pose.linear() * rim.axis;
        touch_rim(search, shape, centre, axis, rim.radius);
        if (rim.next_on_edge < 0) {
            continue;
        }
        const Eigen::Vector3d run = pose * robot.rims()[static_cast<std::size_t>(rim.next_on_edge)].centre - centre;
        const Eigen::Vector3d start = centre + rim.radius * axis.cross(run).normalized();
        search.add_minima(
            shape,
            [&](double share) -> CurvePoint {
                return {start + share * run, run};
            },
            0, 1, run_samples);
    }
}

void touch_balls(Search &search, const Robot &robot) {
    for (const BodyBalls &own : robot.balls()) {
        const PlacedBody &body = robot.bodies()[static_cast<std::size_t>(own.body)];
        int shape = own.first_shape;
        for (const Ball &ball : own.balls) {
            const Eigen::Vector3d centre = body.point(ball.centre);
            Clearance clearance = search.clearance(centre);
            clearance.distance -= ball.radius;
            search.add(shape++, centre - ball.radius * clearance.normal, clearance);
        }
    }
}

}  // namespace

void ground_touches(const Robot &robot, const Ground &ground, std::vector<Touch> &touches) {
    touches.clear();
    for (int piece = 0; piece < ground.pieces(); piece++) {
        Search search(ground, piece, touches);
        touch_crawlers(search, robot);
        touch_balls(search, robot);
    }
}

}  // namespace limphome
