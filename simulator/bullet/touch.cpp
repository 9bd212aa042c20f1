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
constexpr double most_bent = 0.4;     // sine of the angle up to which the lowest point of a circle is the only one

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

    // Adds the only such point, which is less than `width` from the parameter 0, where the slope changes by about
    // `change` per parameter. Between the ends of that the slope goes from below 0 to above.
    template <typename Curve>
    void add_minimum(int shape, const Curve &curve, double width, double change) {
        Sample before = sample(curve, 0);
        if (before.clearance.distance - std::abs(before.slope) * width > 2 * touch_reach) {
            return;
        }
        double parameter = std::clamp(-before.slope / change, -width, width);
        for (int i = 0; i < most_refinements && parameter != before.parameter; i++) {
            const Sample next = sample(curve, parameter);
            change = (next.slope - before.slope) / (next.parameter - before.parameter);
            before = next;
            if (std::abs(next.slope) < fine) {
                break;
            }
            parameter = std::clamp(next.parameter - next.slope / change, -width, width);
        }
        add(shape, before.point, before.clearance);
    }

    // Whether all within `radius` of the point is too far from the ground to touch it.
    bool is_far(const Eigen::Vector3d &point, double radius) const {
        return clearance(point).distance > radius + touch_reach;
    }

    // Likewise of all ground, and quickly told; false means nothing.
    bool is_high(const Eigen::Vector3d &point, double radius) const {
        return ground_.is_far(point, radius + touch_reach);
    }

    // The ground, as a height over its plane, is the only piece with a bound to its bending.
    bool is_base() const { return piece_ == Ground::base_piece; }
    double bend() const { return ground_.bend(); }

   private:
    template <typename Curve>
    Sample sample(const Curve &curve, double parameter) const {
        const CurvePoint at = curve(parameter);
        const Clearance free = clearance(at.point);
        return {parameter, at.point, free, free.normal.dot(at.rate)};
    }

    // Where the slope changes its sign: by secants through the last two points, and by halving where those do not help.
    template <typename Curve>
    Sample refine(const Curve &curve, Sample low, Sample high) const {
        const double enough = fine * (high.parameter - low.parameter);
        Sample before = low, best = high;
        for (int i = 0; i < most_refinements && high.parameter - low.parameter > enough; i++) {
            double parameter =
                best.parameter - best.slope * (best.parameter - before.parameter) / (best.slope - before.slope);
            const bool between = parameter > low.parameter && parameter < high.parameter;
            if (i % 4 == 3 || !between) {
                parameter = 0.5 * (low.parameter + high.parameter);
            }
            before = best;
            best = sample(curve, parameter);
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
//
// Seen from the angle t from where it is lowest against the ground below its centre, its height above the ground
// changes by r (sin(t) s / n + e): s is the share of the normal that lies in its plane, n the normal's part upwards and
// e at most the change of the ground's gradient within r. So it is lowest where |sin(t)| < r bend n / s, and if that is
// small enough nowhere else.
void touch_rim(Search &search, int shape, const Eigen::Vector3d &centre, const Eigen::Vector3d &axis, double radius) {
    if (search.is_high(centre, radius)) {
        return;
    }
    const Clearance middle = search.clearance(centre);
    const Eigen::Vector3d down = axis.dot(middle.normal) * axis - middle.normal;
    if (middle.distance > radius + touch_reach || down.squaredNorm() < 1e-6) {  // far, or lying flat
        return;
    }
    const double share = down.norm();
    const Eigen::Vector3d start = radius / share * down, across = axis.cross(start);
    const auto circle = [&](double angle) -> CurvePoint {
        const double c = std::cos(angle), s = std::sin(angle);
        return {centre + c * start + s * across, c * across - s * start};
    };
    const double sine = radius * search.bend() * middle.normal.z() / share;
    if (search.is_base() && sine < most_bent) {
        search.add_minimum(shape, circle, std::asin(sine), radius * share);
    } else {
        search.add_minima(shape, circle, -0.5 * arc, 0.5 * arc, arc_samples);
    }
}

// The flat run from one rounded end to the next; a plane has no point that is nearer to it than those beside.
void touch_run(Search &search, int shape, const Eigen::Vector3d &start, const Eigen::Vector3d &run) {
    const bool even = search.is_base() && search.bend() == 0;
    if (even || search.is_far(start + 0.5 * run, 0.5 * run.norm())) {
        return;
    }
    search.add_minima(
        shape,
        [&](double share) -> CurvePoint {
            return {start + share * run, run};
        },
        0, 1, run_samples);
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
        touch_run(search, shape, centre + rim.radius * axis.cross(run).normalized(), run);
    }
}

void touch_balls(Search &search, const Robot &robot) {
    for (const BodyBalls &own : robot.balls()) {
        const PlacedBody &body = robot.bodies()[static_cast<std::size_t>(own.body)];
        if (search.is_high(body.origin, own.farthest)) {
            continue;
        }
        int shape = own.first_shape;
        for (const Ball &ball : own.balls) {
            const Eigen::Vector3d centre = body.point(ball.centre);
            if (!search.is_high(centre, ball.radius)) {
                Clearance clearance = search.clearance(centre);
                clearance.distance -= ball.radius;
                search.add(shape, centre - ball.radius * clearance.normal, clearance);
            }
            shape++;
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
