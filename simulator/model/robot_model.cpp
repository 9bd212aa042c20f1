#include "model/robot_model.h"

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Eigenvalues>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace limphome {
namespace {

// Collects what urdfdom would print, for the text of the exception.
class ParserErrors final : public console_bridge::OutputHandler {
   public:
    ParserErrors() { console_bridge::useOutputHandler(this); }
    ~ParserErrors() override { console_bridge::restorePreviousOutputHandler(); }
    ParserErrors(const ParserErrors &) = delete;
    ParserErrors &operator=(const ParserErrors &) = delete;

    void log(const std::string &message, console_bridge::LogLevel level, const char *, int) override {
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
            text += ": " + message;
        }
    }

    std::string text;
};

// Joint that moves, not yet claimed by an actuator of the extension.
struct FreeJoint {
    urdf::JointConstSharedPtr joint;
    int parent;               // body
    Eigen::Isometry3d frame;  // of the joint in that body
};

Eigen::Vector3d to_eigen(const urdf::Vector3 &v) {
    return {v.x, v.y, v.z};
}

Eigen::Isometry3d to_eigen(const urdf::Pose &pose) {
    const urdf::Rotation &r = pose.rotation;
    return Eigen::Translation3d(to_eigen(pose.position)) * Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized();
}

// Builds a RobotModel from the two views of one file: urdfdom's and TinyXML's.
class Reader {
   public:
    explicit Reader(const std::string &path) : path_(path) {}
    RobotModel read();

   private:
    [[noreturn]] void refuse(const std::string &element, const std::string &why) const {
        throw std::runtime_error(path_ + ": " + element + ": " + why);
    }

    void parse();
    void merge(const urdf::LinkConstSharedPtr &link, int body, const Eigen::Isometry3d &frame);
    void merge_inertia(const urdf::Link &link, Body &body, const Eigen::Isometry3d &frame) const;
    void merge_collisions(const urdf::Link &link, Body &body, const Eigen::Isometry3d &frame) const;
    FreeJoint take_joint(const TiXmlElement &element, Actuator &actuator);
    void add_body(const FreeJoint &moved);
    void add_crawler(const TiXmlElement &element);
    void add_arm_joint(const TiXmlElement &element);
    void add_tip(const TiXmlElement &element);

    std::string describe(const TiXmlElement &element) const;
    std::string text(const TiXmlElement &element, const char *attribute) const;
    std::vector<double> numbers(const TiXmlElement &element, const char *attribute, std::size_t count) const;
    double number(const TiXmlElement &element, const char *attribute) const {
        return numbers(element, attribute, 1)[0];
    }
    double positive(const TiXmlElement &element, const char *attribute) const;
    Eigen::Vector3d vector(const TiXmlElement &element, const char *attribute) const {
        return Eigen::Vector3d(numbers(element, attribute, 3).data());
    }

    std::string path_;
    TiXmlDocument document_;
    urdf::ModelInterfaceSharedPtr urdf_;
    RobotModel model_;
    std::map<std::string, FreeJoint> free_joints_;
    std::map<std::string, std::pair<int, Eigen::Isometry3d>> links_;  // body and frame in it of every merged link
};

std::string Reader::describe(const TiXmlElement &element) const {
    return "line " + std::to_string(element.Row()) + ": <" + element.ValueStr() + ">";
}

std::string Reader::text(const TiXmlElement &element, const char *attribute) const {
    const char *value = element.Attribute(attribute);
    if (value == nullptr) {
        refuse(describe(element), std::string("attribute ") + attribute + " is missing");
    }
    return value;
}

std::vector<double> Reader::numbers(const TiXmlElement &element, const char *attribute, std::size_t count) const {
    const std::string value = text(element, attribute);
    std::vector<double> result;
    const char *next = value.data();
    const char *const end = next + value.size();
    for (;;) {
        next += std::strspn(next, " \t\r\n");
        double x = 0;
        const auto [rest, error] = std::from_chars(next, end, x);
        if (error != std::errc() || !std::isfinite(x)) {
            break;
        }
        result.push_back(x);
        next = rest;
    }
    if (next != end || result.size() != count) {
        refuse(describe(element), std::string(attribute) + "=\"" + value + "\" must be " + std::to_string(count) +
                                      (count == 1 ? " number" : " numbers"));
    }
    return result;
}

double Reader::positive(const TiXmlElement &element, const char *attribute) const {
    const double value = number(element, attribute);
    if (value <= 0) {
        refuse(describe(element), std::string(attribute) + " must be above 0");
    }
    return value;
}

void Reader::parse() {
    if (std::filesystem::is_directory(path_)) {  // of which TinyXML would take the length
        throw std::runtime_error(path_ + ": cannot be read: it is a folder");
    }
    if (!document_.LoadFile(path_)) {
        if (document_.ErrorId() == TiXmlBase::TIXML_ERROR_OPENING_FILE) {
            throw std::runtime_error(path_ + ": cannot be opened");
        }
        // it gives no line where it has found no element at all
        const std::string line = document_.ErrorRow() > 0 ? "line " + std::to_string(document_.ErrorRow()) + ": " : "";
        throw std::runtime_error(path_ + ": " + line + document_.ErrorDesc());
    }
    TiXmlPrinter printer;
    document_.Accept(&printer);
    ParserErrors errors;
    urdf_ = urdf::parseURDF(printer.Str());
    if (!urdf_) {
        throw std::runtime_error(path_ + ": not a valid URDF" + errors.text);
    }
}

void Reader::merge_inertia(const urdf::Link &link, Body &body, const Eigen::Isometry3d &frame) const {
    const std::string element = "<link name=\"" + link.name + "\">";
    if (!link.inertial) {
        refuse(element, "<inertial> is missing");
    }
    const urdf::Inertial &inertial = *link.inertial;
    if (!(inertial.mass > 0) || !std::isfinite(inertial.mass)) {
        refuse(element, "<mass> must be above 0");
    }
    Eigen::Matrix3d inertia;
    inertia << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy, inertial.iyz, inertial.ixz,
        inertial.iyz, inertial.izz;
    if (!inertia.allFinite() || Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues()[0] <= 0) {
        refuse(element, "<inertia> must be positive definite");
    }
    const Eigen::Isometry3d pose = frame * to_eigen(inertial.origin);
    if (!pose.matrix().allFinite()) {
        refuse(element, "<origin> of <inertial> must be finite");
    }
    const double mass = body.mass + inertial.mass;
    const Eigen::Vector3d centre = (body.mass * body.centre + inertial.mass * pose.translation()) / mass;
    const auto about = [&centre](double m, const Eigen::Vector3d &at) -> Eigen::Matrix3d {  // parallel axes
        const Eigen::Vector3d r = at - centre;
        return m * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    };
    body.inertia += about(body.mass, body.centre) + pose.linear() * inertia * pose.linear().transpose() +
                    about(inertial.mass, pose.translation());
    body.mass = mass;
    body.centre = centre;
}

// Spheres touch as they are, boxes at their corners; URDF's other shapes are refused.
void Reader::merge_collisions(const urdf::Link &link, Body &body, const Eigen::Isometry3d &frame) const {
    for (const urdf::CollisionSharedPtr &collision : link.collision_array) {
        const Eigen::Isometry3d pose = frame * to_eigen(collision->origin);
        const auto *sphere = dynamic_cast<const urdf::Sphere *>(collision->geometry.get());
        const auto *box = dynamic_cast<const urdf::Box *>(collision->geometry.get());
        const double least = sphere != nullptr ? sphere->radius : box != nullptr ? to_eigen(box->dim).minCoeff() : 0.0;
        if (!pose.matrix().allFinite() || !(least >= 0) || !std::isfinite(least)) {
            refuse("<link name=\"" + link.name + "\">", "<collision> must be finite and of no negative size");
        }
        if (sphere != nullptr) {
            body.balls.push_back({pose.translation(), sphere->radius});
        } else if (box != nullptr) {
            for (int corner = 0; corner < 8; corner++) {
                const Eigen::Vector3d sign((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2 & 1) - 0.5);
                body.balls.push_back({pose * sign.cwiseProduct(to_eigen(box->dim)), 0.0});
            }
        } else {
            refuse("<link name=\"" + link.name + "\">", "<collision> must be a sphere or a box");
        }
    }
}

void Reader::merge(const urdf::LinkConstSharedPtr &link, int body, const Eigen::Isometry3d &frame) {
    Body &merged = model_.bodies[static_cast<std::size_t>(body)];
    merge_inertia(*link, merged, frame);
    merge_collisions(*link, merged, frame);
    links_[link->name] = {body, frame};
    for (const urdf::JointSharedPtr &joint : link->child_joints) {
        const Eigen::Isometry3d child = frame * to_eigen(joint->parent_to_joint_origin_transform);
        if (!child.matrix().allFinite()) {
            refuse("<joint name=\"" + joint->name + "\">", "<origin> must be finite");
        }
        if (joint->type == urdf::Joint::FIXED) {
            merge(urdf_->getLink(joint->child_link_name), body, child);
        } else {
            free_joints_[joint->name] = {joint, body, child};
        }
    }
}

FreeJoint Reader::take_joint(const TiXmlElement &element, Actuator &actuator) {
    const std::string name = text(element, "joint");
    const auto found = free_joints_.find(name);
    if (found == free_joints_.end()) {
        const bool known = urdf_->getJoint(name) != nullptr;
        refuse(describe(element), "joint " + name +
                                      (known ? " is fixed, or named twice, or named before the joint that carries it"
                                             : " is not in the file"));
    }
    if (model_.actuators.size() == max_actuators) {
        refuse(describe(element), "there are more than " + std::to_string(max_actuators) + " actuators");
    }
    FreeJoint taken = std::move(found->second);
    free_joints_.erase(found);
    const std::string joint = "<joint name=\"" + name + "\">";
    const urdf::JointLimitsSharedPtr &limits = taken.joint->limits;
    if (!limits || !(limits->effort > 0) || !(limits->velocity > 0)) {
        refuse(joint, "<limit> must give effort and velocity above 0");
    }
    if (to_eigen(taken.joint->axis).norm() < 1e-6) {
        refuse(joint, "<axis> must not be zero");
    }
    actuator.name = name;
    actuator.effort = limits->effort;
    actuator.speed = limits->velocity;
    return taken;
}

void Reader::add_body(const FreeJoint &moved) {
    const int index = static_cast<int>(model_.bodies.size());
    Body body;
    body.name = moved.joint->child_link_name;
    body.parent = moved.parent;
    body.joint = moved.frame;
    body.axis = to_eigen(moved.joint->axis).normalized();
    model_.bodies.push_back(body);
    merge(urdf_->getLink(body.name), index, Eigen::Isometry3d::Identity());
}

void Reader::add_crawler(const TiXmlElement &element) {
    Actuator actuator;
    const FreeJoint moved = take_joint(element, actuator);
    if (moved.joint->type != urdf::Joint::CONTINUOUS) {
        refuse("<joint name=\"" + actuator.name + "\">", "the joint of a crawler must be continuous");
    }
    if (moved.parent != 0) {
        refuse(describe(element), "a crawler must be fixed to the base");
    }
    const auto [body, parent_frame] = links_.at(moved.joint->parent_link_name);
    Crawler crawler;
    crawler.centre = parent_frame * vector(element, "xyz");
    crawler.axis = moved.frame.linear() * to_eigen(moved.joint->axis).normalized();
    crawler.length = positive(element, "length");
    crawler.width = positive(element, "width");
    crawler.radius = positive(element, "radius");
    if (crawler.length < 2 * crawler.radius) {
        refuse(describe(element), "length must be at least twice the radius");
    }
    if (crawler.axis.cross(Eigen::Vector3d::UnitZ()).x() < 0.5) {
        refuse("<joint name=\"" + actuator.name + "\">", "<axis> of a crawler must point to the left");
    }
    actuator.lower = -std::numeric_limits<double>::infinity();
    actuator.upper = std::numeric_limits<double>::infinity();
    model_.crawlers.push_back(crawler);
    model_.actuators.push_back(actuator);
    add_body(moved);
}

void Reader::add_arm_joint(const TiXmlElement &element) {
    Actuator actuator;
    const FreeJoint moved = take_joint(element, actuator);
    const std::string joint = "<joint name=\"" + actuator.name + "\">";
    if (moved.joint->type != urdf::Joint::REVOLUTE) {
        refuse(joint, "the joint of an arm must be revolute");
    }
    actuator.lower = moved.joint->limits->lower;
    actuator.upper = moved.joint->limits->upper;
    if (!(actuator.lower < actuator.upper)) {
        refuse(joint, "lower <limit> must be below upper");
    }
    actuator.home = number(element, "home");
    if (actuator.home < actuator.lower || actuator.home > actuator.upper) {
        refuse(describe(element), "home must lie within the limits of joint " + actuator.name);
    }
    model_.actuators.push_back(actuator);
    add_body(moved);
}

void Reader::add_tip(const TiXmlElement &element) {
    const std::string name = text(element, "link");
    const auto found = links_.find(name);
    if (found == links_.end()) {
        refuse(describe(element), "link " + name + " is not in the file");
    }
    const auto &[body, frame] = found->second;
    model_.bodies[static_cast<std::size_t>(body)].balls.push_back(
        {frame * vector(element, "xyz"), positive(element, "radius")});
}

RobotModel Reader::read() {
    parse();
    model_.name = urdf_->getName();
    model_.bodies.emplace_back();
    model_.bodies[0].name = urdf_->getRoot()->name;
    merge(urdf_->getRoot(), 0, Eigen::Isometry3d::Identity());

    const TiXmlElement *extension = document_.RootElement()->FirstChildElement("limphome");
    if (extension == nullptr) {
        refuse("<robot>", "<limphome> is missing");
    }
    for (auto *e = extension->FirstChildElement("crawler"); e != nullptr; e = e->NextSiblingElement("crawler")) {
        add_crawler(*e);
    }
    if (model_.crawlers.size() != num_crawlers) {
        refuse(describe(*extension), "there must be two <crawler>, left and right");
    }
    if (model_.crawlers[0].centre.y() <= model_.crawlers[1].centre.y()) {
        refuse(describe(*extension), "the left <crawler> must come first");
    }
    for (auto *e = extension->FirstChildElement("arm"); e != nullptr; e = e->NextSiblingElement("arm")) {
        add_arm_joint(*e);
    }
    if (!free_joints_.empty()) {
        refuse("<joint name=\"" + free_joints_.begin()->first + "\">", "moves, but is no actuator of <limphome>");
    }
    for (auto *e = extension->FirstChildElement("tip"); e != nullptr; e = e->NextSiblingElement("tip")) {
        add_tip(*e);
    }
    return model_;
}

}  // namespace

double RobotModel::mass() const {
    double sum = 0;
    for (const Body &body : bodies) {
        sum += body.mass;
    }
    return sum;
}

RobotModel read_robot(const std::string &path) {
    return Reader(path).read();
}

}  // namespace limphome
