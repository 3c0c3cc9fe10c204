// The bounding box of each robot.
#include <map>

#include "description/world_robots.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct RobotsGeometry {
  static constexpr auto id = "robots.geometry/1";
  static constexpr auto summary = "the box that each robot fills, with every joint at zero";
  static constexpr auto phase = MUSTER_SENSE;

  explicit RobotsGeometry(Setup& s)
      : robots(s, description::Meshes::import),
        geometry(s.write<Geometry>("robot/*/geometry", MUSTER_SENSED)),
        model(s.write<description::Model>("robot/*/geometry_model")) {
    for (std::size_t row = 1; row <= robots.size(); ++row) {
      const auto* robot = robots.of(static_cast<double>(row));
      if (robot) boxes.emplace(robot, box_of(*robot));
    }
  }

  // A robot without a model has an empty box.
  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[geometry].size(); ++i) {
      k[model][i].model = WorldRobots::model_of(k.last(model)[i].model, i);
      const auto known = boxes.find(robots.of(k[model][i].model));
      k[geometry][i] = known == boxes.end() ? Geometry{} : known->second;
    }
  }

  static Geometry box_of(const description::Robot& robot) {
    const Eigen::AlignedBox3d box = bounds(robot);
    if (box.isEmpty()) return {};
    const Eigen::Vector3d middle = box.center(), size = box.sizes();
    return {middle.x(), middle.y(), middle.z(), size.x(), size.y(), size.z()};
  }

  WorldRobots robots;
  Out<Geometry> geometry;
  Out<description::Model> model;
  std::map<const description::Robot*, Geometry> boxes;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsGeometry)
