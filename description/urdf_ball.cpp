#include "description/urdf_check.hpp"

namespace muster::description {

// URDF knows no such joint. Marked is a floating one, so that whoever does not know the mark sees a joint that lets
// more move, and no error.
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
