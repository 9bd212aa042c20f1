#include "model/robot_model.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "laboratory.h"

namespace limphome {
namespace {

std::string file_text(const std::string &path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// The paper's robot with one passage replaced.
class Altered {
   public:
    Altered(const std::string &passage, const std::string &replacement)
        : path_(testing::TempDir() + "limphome_altered_" +
                testing::UnitTest::GetInstance()->current_test_info()->name() + ".urdf") {
        std::string text = file_text(laboratory::robot_file());
        const std::size_t place = text.find(passage);
        EXPECT_NE(place, std::string::npos) << passage;
        text.replace(place, passage.size(), replacement);
        std::ofstream(path_) << text;
    }
    ~Altered() { std::remove(path_.c_str()); }
    const std::string &path() const { return path_; }

   private:
    std::string path_;
};

// The text of the exception, which must name the file.
std::string refusal(const std::string &path) {
    try {
        read_robot(path);
    } catch (const std::runtime_error &error) {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
        return error.what();
    }
    return "was accepted";
}

void expect_refusal(const std::string &passage, const std::string &replacement, const std::string &mentioned) {
    const Altered altered(passage, replacement);
    EXPECT_NE(refusal(altered.path()).find(mentioned), std::string::npos) << refusal(altered.path());
}

TEST(RobotModel, ReadsThePapersRobot) {
    const RobotModel model = laboratory::paper_robot();
    ASSERT_EQ(model.actuators.size(), 5u);
    ASSERT_EQ(model.bodies.size(), 6u);
    EXPECT_EQ(model.actuators[3].name, "boom");
    EXPECT_EQ(model.bodies[5].parent, 4);
    EXPECT_EQ(model.actuators[4].home, -1.5);
    EXPECT_EQ(model.actuators[2].effort, 3000);
    EXPECT_NEAR(model.mass(), 498 + 1 + 1 + 350 + 60 + 35, 1e-9);
    EXPECT_EQ(model.crawlers[1].width, 0.30);
}

// A link on a fixed joint becomes part of the body it hangs on.
TEST(RobotModel, MergesFixedLinks) {
    const Altered altered("<!-- What URDF has no words for.",
                          "<link name='box'><inertial><mass value='100'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
                          "ixz='0' iyz='0'/></inertial></link><joint name='bolts' type='fixed'><parent link='base'/>"
                          "<child link='box'/><origin xyz='0 0 1.3'/></joint>"
                          "<!-- What URDF has no words for.");
    const RobotModel plain = laboratory::paper_robot();
    const RobotModel model = read_robot(altered.path());
    ASSERT_EQ(model.bodies.size(), 6u);
    EXPECT_NEAR(model.bodies[0].mass, 598, 1e-9);
    EXPECT_NEAR(model.bodies[0].centre.z(), (498 * 0.3 + 100 * 1.3) / 598, 1e-12);
    // reduced mass times distance squared is what two bodies add about their common centre
    EXPECT_NEAR(model.bodies[0].inertia(0, 0), 75 + 1 + 498.0 * 100 / 598 * 1.0, 1e-9);
    EXPECT_NEAR(model.bodies[0].inertia(2, 2), 165 + 1, 1e-9);
    EXPECT_EQ(plain.bodies.size(), model.bodies.size());
}

TEST(RobotModel, HasAsManyArmJointsAsTheFileGives) {
    // without arm: as one rigid boom
    std::string text = file_text(laboratory::robot_file());
    const auto erase = [&text](const std::string &passage) { text.replace(text.find(passage), passage.size(), ""); };
    erase("<arm joint=\"arm\" home=\"-1.5\"/>");
    const std::string joint = "<joint name=\"arm\" type=\"revolute\">";
    text.replace(text.find(joint), joint.size(), "<joint name=\"arm\" type=\"fixed\">");
    const std::string path = testing::TempDir() + "limphome_short.urdf";
    std::ofstream(path) << text;
    const RobotModel model = read_robot(path);
    std::remove(path.c_str());
    EXPECT_EQ(model.actuators.size(), 4u);
    EXPECT_EQ(model.bodies.size(), 5u);
    ASSERT_EQ(model.bodies[4].balls.size(), 2u);
    EXPECT_NEAR(model.bodies[4].balls[1].centre.x(), 1.9, 1e-12);  // the tip, now on the boom
    World world(model, laboratory::left_locked());
    laboratory::run(world, {}, 1);
    EXPECT_FALSE(world.diverged());
}

TEST(RobotModel, RefusesWhatIsNotThere) {
    const std::string missing = testing::TempDir() + "limphome_no_such.urdf";
    EXPECT_NE(refusal(missing), "was accepted");
}

TEST(RobotModel, RefusesBrokenXml) {
    expect_refusal("</robot>", "</robo>", "line");
}
TEST(RobotModel, RefusesMissingExtension) {
    std::string text = file_text(laboratory::robot_file());
    const std::size_t begin = text.find("  <limphome>"), end = text.find("</limphome>") + 11;
    expect_refusal(text.substr(begin, end - begin), "", "<limphome> is missing");
}
TEST(RobotModel, RefusesUnknownJoint) {
    expect_refusal("<arm joint=\"boom\"", "<arm joint=\"bom\"", "joint bom is not in the file");
}
TEST(RobotModel, RefusesJointNamedTwice) {
    expect_refusal("<arm joint=\"boom\" home=\"0.6\"", "<arm joint=\"swing\" home=\"0.6\"", "joint swing is");
}
TEST(RobotModel, RefusesMovingJointThatIsNoActuator) {
    expect_refusal("<arm joint=\"arm\" home=\"-1.5\"/>", "", "<joint name=\"arm\">: moves");
}
TEST(RobotModel, RefusesNegativeMass) {
    expect_refusal("<mass value=\"350\"/>", "<mass value=\"-350\"/>", "<link name=\"upper_body\">: <mass>");
}
TEST(RobotModel, RefusesZeroMass) {
    expect_refusal("<mass value=\"60\"/>", "<mass value=\"0\"/>", "<link name=\"boom\">: <mass>");
}
TEST(RobotModel, RefusesMassThatIsNoNumber) {
    expect_refusal("<mass value=\"60\"/>", "<mass value=\"heavy\"/>", "<link name=\"boom\">: <mass>");
}
TEST(RobotModel, RefusesMissingInertial) {
    expect_refusal(
        "<inertial><mass value=\"1\"/><inertia ixx=\"2\" iyy=\"4\" izz=\"2\" ixy=\"0\" ixz=\"0\" "
        "iyz=\"0\"/></inertial>",
        "", "<link name=\"left_sprocket\">: <inertial> is missing");
}
TEST(RobotModel, RefusesInertiaThatIsNotPositiveDefinite) {
    expect_refusal("ixx=\"30\"", "ixx=\"-30\"", "<link name=\"upper_body\">: <inertia>");
}
TEST(RobotModel, RefusesMissingLimit) {
    expect_refusal("<limit effort=\"1000\" velocity=\"5\"/>", "", "<joint name=\"left_crawler\">: <limit>");
}
TEST(RobotModel, RefusesMissingEffort) {
    expect_refusal("effort=\"3000\" velocity=\"1\"", "velocity=\"1\"", "swing");
}
TEST(RobotModel, RefusesZeroEffort) {
    expect_refusal("effort=\"3000\"", "effort=\"0\"", "<joint name=\"swing\">: <limit>");
}
TEST(RobotModel, RefusesSwappedLimits) {
    expect_refusal("lower=\"-2.6\" upper=\"2.6\"", "lower=\"2.6\" upper=\"-2.6\"", "<joint name=\"swing\">: lower");
}
TEST(RobotModel, RefusesHomeOutsideTheLimits) {
    expect_refusal("home=\"0.6\"", "home=\"1.6\"", "home must lie within the limits of joint boom");
}
TEST(RobotModel, RefusesBadNumbersInTheExtension) {
    expect_refusal("radius=\"0.08\"/>\n    <support", "radius=\"round\"/>\n    <support", "radius=\"round\" must be");
}
TEST(RobotModel, RefusesMissingAttribute) {
    expect_refusal("width=\"0.30\" radius=\"0.18\"/>", "width=\"0.30\"/>", "attribute radius is missing");
}
TEST(RobotModel, RefusesNegativeWidth) {
    expect_refusal("width=\"0.30\"", "width=\"-0.30\"", "width must be above 0");
}
TEST(RobotModel, RefusesSwappedCrawlers) {
    expect_refusal("xyz=\"0 0.475 0.18\"", "xyz=\"0 -0.9 0.18\"", "the left <crawler> must come first");
}
TEST(RobotModel, RefusesSingleCrawler) {
    expect_refusal(
        "<crawler joint=\"right_crawler\" xyz=\"0 -0.475 0.18\" length=\"1.6\" width=\"0.30\" "
        "radius=\"0.18\"/>",
        "", "two <crawler>");
}
TEST(RobotModel, RefusesTipOnUnknownLink) {
    expect_refusal("<tip link=\"arm\"", "<tip link=\"hand\"", "link hand is not in the file");
}
TEST(RobotModel, RefusesCollisionShapesOfNegativeSize) {
    expect_refusal("<sphere radius=\"0.08\"/>", "<sphere radius=\"-0.08\"/>", "<link name=\"boom\">");
}
TEST(RobotModel, RefusesJointsThatAreNowhere) {
    expect_refusal("<origin xyz=\"0 0 0.50\"/>", "<origin xyz=\"0 0 inf\"/>", "swing");
}
TEST(RobotModel, RefusesCentresOfMassThatAreNowhere) {
    expect_refusal("<origin xyz=\"-0.10 0 0.35\"/>", "<origin xyz=\"-0.10 0 inf\"/>", "upper_body");
}
// All of it is as it should be, but nothing can be computed with it.
TEST(RobotModel, RobotThatCannotBeSimulatedIsRefusedByTheWorld) {
    const Altered altered("<mass value=\"350\"/>", "<mass value=\"1e200\"/>");
    const RobotModel model = read_robot(altered.path());
    try {
        const World world(model, laboratory::left_locked());
        FAIL() << "was accepted";
    } catch (const std::runtime_error &error) {
        EXPECT_NE(std::string(error.what()).find("robot crawler"), std::string::npos) << error.what();
    }
}
TEST(RobotModel, RefusesCollisionShapesItCannotUse) {
    expect_refusal("<sphere radius=\"0.08\"/>", "<cylinder radius=\"0.08\" length=\"1\"/>", "<link name=\"boom\">");
}

}  // namespace
}  // namespace limphome
