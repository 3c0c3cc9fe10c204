#include "description/urdf_check.hpp"

namespace muster::description {

// URDF has no such joint. A mark on a floating joint makes it a ball: a program that ignores the mark sees a joint with
// more freedom, and no error.
void read_ball(const Source& source, const tinyxml2::XMLElement& element, Robot& robot) {
  only_attributes(source, element, {"joint"});
  Joint& joint = robot.joints[find_joint(source, element, "joint", robot)];
  const int line = element.GetLineNum();
  only_children(source, element, {});
  if (joint.kind == JointKind::ball) source.fail(line, "<ball> joint '" + joint.name + "' is a ball already");
  if (joint.kind != JointKind::floating) {
    source.fail(line, "<ball> joint '" + joint.name + "' is " + law_of(joint.kind).name + "; expected type 'floating'");
  }
  joint.kind = JointKind::ball;
}

}  // namespace muster::description
