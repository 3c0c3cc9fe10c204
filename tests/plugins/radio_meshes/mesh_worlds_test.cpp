// Meshes in running worlds: their losses, motion around them, and faults of files.
#include <cmath>

#include "tests/plugins/radio/world_of.hpp"
#include "text/error.hpp"

namespace muster {
namespace {

// A box from the origin to (x, y, z), closed and counter-clockwise from outside.
std::string box_obj(const std::string& x, const std::string& y, const std::string& z) {
  std::string text;
  for (const auto& up : {std::string("0"), z}) {
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{{"0", "0"}, {x, "0"}, {x, y}, {"0", y}})
      text += "v " + a + ' ' + b + ' ' + up + '\n';
  }
  return text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

const std::string materials = "<material name=\"stone\" loss=\"9\"/><material name=\"tin\" loss=\"2.5\"/>\n";
const std::string channel = "<radio.multiwall/><radio.meshes name=\"meshes\"/>\n";

double loss(const Simulation& sim, const std::string& from, const std::string& to) {
  return -by_pair(sim, "link/*/level@meshes").at({from, to});
}

TEST(MeshWorld, ASolidCountsOnceAndASheetAtEachCrossing) {
  for (const auto& [kind, outside, inside] :
       std::vector<std::tuple<std::string, double, double>>{{"solid", 9, 9}, {"sheet", 18, 9}}) {
    const Folder folder;
    folder.put("pillar.obj", box_obj("1", "1", "3"));
    Simulation sim =
        world_of(folder, materials + "<mesh file=\"pillar.obj\" material=\"stone\" at=\"4 -0.5 0\" kind=\"" + kind +
                             "\"/>" + station("west", "0 0 1") + station("east", "10 0 1") + station("in", "4.5 0 1") +
                             station("over", "10 0 6") + channel);
    run(sim, 1);
    EXPECT_EQ(loss(sim, "west", "east"), outside);
    EXPECT_EQ(loss(sim, "west", "in"), inside);
    EXPECT_EQ(loss(sim, "east", "in"), inside);
    EXPECT_EQ(loss(sim, "over", "east"), 0);
    const auto levels = by_pair(sim, "link/*/level@meshes");
    for (const auto& [pair, level] : levels) EXPECT_TRUE(same_bits(level, levels.at({pair.second, pair.first})));
  }
}

TEST(MeshWorld, EachHasItsMaterial) {
  const Folder folder;
  folder.put("pillar.obj", box_obj("1", "1", "3"));
  Simulation sim =
      world_of(folder, "<mesh file=\"pillar.obj\" material=\"tin\" at=\"2 -0.5 0\"/>" + materials +
                           "<mesh file=\"pillar.obj\" material=\"stone\" at=\"4 -0.5 0\"/>" + station("a", "0 0 1") +
                           station("b", "10 0 1") + station("c", "3.5 0 1") + channel);
  run(sim, 1);
  EXPECT_EQ(loss(sim, "a", "b"), 11.5);
  EXPECT_EQ(loss(sim, "a", "c"), 2.5);
  EXPECT_EQ(loss(sim, "b", "c"), 9);
}

TEST(MeshWorld, IsScaledThenTurnedThenMoved) {
  const Folder folder;
  folder.put("slab.obj", box_obj("400", "10", "300"));  // centimetres
  Simulation sim = world_of(
      folder,
      materials +
          "<mesh file=\"slab.obj\" material=\"stone\" scale=\"0.01\" yaw=\"1.5707963267948966\" at=\"5 1 0\"/>" +
          station("a", "0 3 1") + station("b", "10 3 1") + station("c", "0 0.5 1") + station("d", "10 0.5 1") +
          station("e", "0 3 3.5") + station("f", "10 3 3.5") + channel);
  run(sim, 1);
  EXPECT_EQ(loss(sim, "a", "b"), 9);
  EXPECT_EQ(loss(sim, "c", "d"), 0);  // south of it
  EXPECT_EQ(loss(sim, "e", "f"), 0);  // above it
}

// A mesh in place of a wall: long, so that no link passes its ends, and as thick.
TEST(MeshWorld, AWallGivenAsAMeshHasTheLossOfTheWall) {
  const Folder folder;
  folder.put("wall.obj", box_obj("0.125", "60", "2.75"));
  std::string radios;
  for (int i = 0; i < 24; ++i) {
    const double x = std::fmod(i * 7.31, 20) - 10, y = std::fmod(i * 3.7, 24) - 12, z = i > 20 ? 6 : 0.25 * (i % 11);
    if (std::abs(x) > 0.1)
      radios += station("s" + std::to_string(i), std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(z));
  }
  const std::string wall = "<wall from=\"0 -30\" to=\"0 30\" height=\"2.75\" thickness=\"0.125\" material=\"stone\"/>";
  const std::string mesh = "<mesh file=\"wall.obj\" material=\"stone\" at=\"-0.0625 -30 0\"/>";
  Simulation with_wall = world_of(folder, materials + wall + radios + "<radio.multiwall/>");
  run(with_wall, 1);
  const auto expected = by_pair(with_wall, "link/*/level@radio.multiwall.walls");
  Simulation with_mesh = world_of(folder, materials + mesh + radios + channel);
  run(with_mesh, 1);
  int crossed = 0;
  for (const auto& [pair, level] : by_pair(with_mesh, "link/*/level@meshes")) {
    EXPECT_EQ(level, expected.at(pair)) << pair.first << ' ' << pair.second;
    crossed += level != 0;
  }
  EXPECT_GT(crossed, 100);
}

TEST(MeshWorld, CountsAreThoseOfWhereRobotsAreNow) {
  const Folder folder;
  folder.put("pillar.obj", box_obj("0.5", "0.5", "2"));
  // test.mover drives r0 along y = 0 from x = 1 m to 4 m and back in 20 ticks.
  const std::string world = materials + "<mesh file=\"pillar.obj\" material=\"stone\" at=\"2.25 2 0\"/>" +
                            station("north", "2.5 6 0.4") + "<robot name=\"r0\" at=\"1 0 0\"/><test.mover/>\n" +
                            channel;
  Simulation sim = world_of(folder, world), remade = world_of(folder, world, 3);
  testing::internal::CaptureStderr();
  int blocked = 0;
  for (int tick = 1; tick <= 40; ++tick) {
    sim.step(), remade.step();
    const double x = 1 + 0.3 * std::min(tick % 20, 20 - tick % 20);
    // The line from (x, 0) to (2.5, 6) meets the pillar between y = 2 and y = 2.5.
    const double near = x + (2.5 - x) * 2 / 6, far = x + (2.5 - x) * 2.5 / 6;
    const bool in_the_way = std::max(near, far) > 2.25 && std::min(near, far) < 2.75;
    EXPECT_EQ(loss(sim, "north", "r0"), in_the_way ? 9 : 0) << tick;
    blocked += in_the_way;
    if (tick % 7 == 0) remade.remake("meshes");
  }
  EXPECT_GT(blocked, 4);
  EXPECT_LT(blocked, 36);
  EXPECT_EQ(sim.digest(), remade.digest());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // nor does Embree take the workers away
}

TEST(MeshWorld, SaysWhatIsWrong) {
  const Folder folder;
  const auto file = folder.put("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.put("empty.stl", "");
  folder.put("page.obj", "<!DOCTYPE html><html>404</html>");
  folder.put("pillar.obj", box_obj("1", "1", "3"));
  const auto refusal = [&](const std::string& mesh) -> std::string {
    try {
      Simulation sim = world_of(folder, materials + mesh + station("a", "0 0 1") + station("b", "1 0 1") + channel);
      run(sim, 1);
    } catch (const Error& refused) {
      std::string said = refused.what();
      const std::string where = file.parent_path().string() + '/';
      for (std::size_t at = 0; (at = said.find(where, at)) != said.npos;) said.erase(at, where.size());
      const std::string folder_itself = file.parent_path().string();
      if (const auto at = said.find(folder_itself); at != said.npos) said.replace(at, folder_itself.size(), ".");
      return said;
    }
    return "";
  };
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"open.obj\" material=\"stone\" kind=\"sheet\"/>"), "");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"open.obj\" material=\"stone\"/>"),
            "world.xml:5:19: meshes (radio.meshes): mesh \"m\" is not closed: the edge "
            "from 0.000 0.000 0.000 to 0.000 1.000 0.000 has 1 triangle; expected a closed surface, or kind=\"sheet\"");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"empty.stl\" material=\"stone\"/>"),
            "world.xml:5:19: meshes (radio.meshes): mesh \"m\": the file \"empty.stl\" is empty");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"page.obj\" material=\"stone\"/>"),
            "world.xml:5:19: meshes (radio.meshes): mesh \"m\": the file \"page.obj\" is an HTML page, "
            "not a mesh");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"absent.obj\" material=\"stone\"/>"),
            "world.xml:5:19: meshes (radio.meshes): mesh \"m\": the file \"absent.obj\" cannot be "
            "opened: No such file or directory");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"/pillar.obj\" material=\"stone\"/>"),
            "world.xml:5:19: meshes (radio.meshes): mesh \"m\": the file \"/pillar.obj\" is outside the "
            "allowed folder; expected a path relative to .");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"pillar.obj\" material=\"stone\" scale=\"1000\"/>"),
            "world.xml:5:19: meshes (radio.meshes): mesh \"m\" reaches beyond 1 km; is its "
            "file in millimetres? expected scale=\"1\"");
  EXPECT_EQ(refusal("<mesh name=\"m\" file=\"pillar.obj\" material=\"granite\"/>"),
            "world.xml:3:44: no material is called \"granite\"; expected one of stone, tin");
  EXPECT_EQ(refusal("<mesh name=\"m\" material=\"stone\"/>"),
            "world.xml:3:1: <mesh> has no attribute \"file\", which it needs; expected a text");
}

}  // namespace
}  // namespace muster
