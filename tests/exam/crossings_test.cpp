// Compares the exam's geometry with the simulator's independent one.
#include <gtest/gtest.h>

#include "made.hpp"
#include "scene/walls.hpp"

namespace muster::exam {
namespace {

TEST(Crossings, AreThoseOfTheScene) {
  std::size_t different = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const GroundTruth site = draw_site(seed, {}, 2000);
    const Data data = draw_data(site, seed, "measured");
    std::vector<scene::Wall> walls;
    std::vector<scene::Door> doors;
    for (const Wall& w : site.plan.walls)
      walls.push_back({w.a.x, w.a.y, w.b.x, w.b.y, 0, w.height, w.thickness, w.material});
    for (const Door& d : site.plan.doors)
      doors.push_back(
          {d.wall, d.at, d.width, d.height, site.plan.walls[static_cast<std::size_t>(d.wall)].material, d.open});
    const scene::Scene truth(walls, doors, 2);
    for (std::size_t i = 0; i < data.size(); ++i, ++all) {
      const Vec3 from = place_of(site, data.readings[i]), to = data.readings[i].at;
      int counts[2] = {0, 0};
      truth.counts({from.x, from.y, from.z}, {to.x, to.y, to.z}, counts);
      const auto row = static_cast<Eigen::Index>(i);
      different += -data.design(row, 2) != counts[0] || -data.design(row, 3) != counts[1];
    }
  }
  // The scene rounds places to a lattice of 0.24 mm. One link in some ten thousand then passes a door's post or a
  // corner on the other side.
  EXPECT_LT(static_cast<double>(different), 5e-4 * static_cast<double>(all));
}

}  // namespace
}  // namespace muster::exam
