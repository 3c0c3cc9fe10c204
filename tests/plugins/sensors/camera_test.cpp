// sensors.camera in a world: what its pictures have of walls, doors, robots and noise, and when.
#include "kernel/record.hpp"
#include "sense_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct Picture {
  Image head;
  std::vector<float> depth;
  std::vector<unsigned char> colour;
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(head.width) + static_cast<std::size_t>(x);
  }
  float at(int x, int y) const { return depth[pixel(x, y)]; }
  int red(int x, int y) const { return colour[3 * pixel(x, y)]; }
};

// Those of the last tick.
std::vector<Picture> pictures(const Simulation& run) {
  const Cells& cells = run.table("image/*/message").table->now();
  std::vector<Picture> result;
  for (const Image& head : told_now<Image>(run, "image/*/message", time_of(run))) {
    const auto& depth = *cells.blobs[static_cast<std::size_t>(head.depth) - 1];
    const auto& colour = *cells.blobs[static_cast<std::size_t>(head.colour) - 1];
    result.push_back({head, std::vector<float>(depth.size() / sizeof(float)), {colour.begin(), colour.end()}});
    std::memcpy(result.back().depth.data(), depth.data(), depth.size());
  }
  return result;
}

const std::string pictured =
    "<material name='brick' loss='4' colour='0.8 0.2 0.1'/><wall name='w' from='5 -4' to='5 4' material='brick'/>"
    "<door name='d' wall='w' at='3.5' width='1' height='2' state='closed'/>"
    "<wall name='behind' from='9 -9' to='9 9' material='brick'/>"
    "<robot name='r' at='0 0 0'/><physics.planar/>";

class Camera : public testing::Test {
 protected:
  Simulation run(const std::string& camera, const std::string& more = "") const {
    return {world_in(folder, pictured + more + "<sensors.camera name='c' robot='r' " + camera + "/>"), standard(),
            options()};
  }
  // After so many ticks of 50 ms.
  Picture after(int ticks, const std::string& camera, const std::string& more = "") const {
    Simulation sim = run(camera, more);
    run_ticks(sim, ticks);
    const auto all = pictures(sim);
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? Picture{{}, std::vector<float>(320 * 240), std::vector<unsigned char>(320 * 240 * 3)} : all[0];
  }
  const Folder folder;
};

TEST_F(Camera, SeesAWallAtItsDepthAndInItsColour) {
  const Picture seen = after(2, "x='0.1' z='1'");
  ASSERT_EQ(seen.depth.size(), 320u * 240u);
  ASSERT_EQ(seen.colour.size(), 3 * 320u * 240u);
  EXPECT_EQ(seen.head.t, 0.1);
  EXPECT_EQ(seen.head.fov, 1.2);
  for (const int x : {20, 160, 300}) EXPECT_NEAR(seen.at(x, 100), 5 - 0.05 - 0.1, 1e-6);
  EXPECT_GT(seen.red(160, 100), 3 * seen.colour[3 * (100 * 320 + 160) + 1]);
  const double focal = 160 / std::tan(0.6);
  EXPECT_NEAR(seen.at(160, 239), 1 / ((239 - 119.5) / focal), 1e-5);  // the ground
}

TEST_F(Camera, ADoorOpensInIt) {
  const std::string opens = "<at t='0.5'><set path='door/d/state' value='open'/></at>";
  EXPECT_NEAR(after(4, "z='1'", opens).at(160, 119), 4.95, 1e-6);
  EXPECT_NEAR(after(12, "z='1'", opens).at(160, 119), 8.95, 1e-6);
}

TEST_F(Camera, AClosedDoorHasTheColourOfItsMaterial) {
  const std::string blue =
      "<material name='panel' loss='4' colour='0.1 0.2 0.8'/><wall name='near' from='3 -4' to='3 4' material='brick'/>"
      "<door name='leaf' wall='near' at='3.5' width='1' height='1.5' material='panel' state='closed'/>";
  const Picture seen = after(2, "z='1'", blue);
  const auto blue_at = [&](int x, int y) { return static_cast<int>(seen.colour[3 * seen.pixel(x, y) + 2]); };
  for (const int x : {20, 160, 300}) EXPECT_NEAR(seen.at(x, 119), 2.95, 1e-6);
  EXPECT_GT(blue_at(160, 119), 3 * seen.red(160, 119));
  EXPECT_GT(seen.red(20, 119), 3 * blue_at(20, 119));  // beside the door
  EXPECT_GT(seen.red(160, 50), 3 * blue_at(160, 50));  // above it
}

TEST_F(Camera, OtherRobotsAreSeenWhileTheyAreThereAndNeverItsOwn) {
  const std::string others =
      "<robot name='other' at='2 0 0'/><at t='0.5'><leave robot='other'/></at>"
      "<at t='1'><robot name='late' at='3 0 0' heading='1.5707963'/></at>";
  const std::string low = "z='0.1'";
  EXPECT_NEAR(after(4, low, others).at(160, 119), 1.9, 0.05);  // a Scarab is 0.2 m long
  EXPECT_NEAR(after(14, low, others).at(160, 119), 4.95, 1e-6);
  EXPECT_NEAR(after(24, low, others).at(160, 119), 3 - 0.0675, 0.05);  // and 0.135 m wide
  EXPECT_NEAR(after(4, "x='-0.5' z='0.1'").at(160, 119), 5.45, 1e-6);  // through the body that carries it
}

TEST_F(Camera, ACopyOfARobotIsSeenAsThatOne) {
  Simulation sim = run("z='0.1'");
  run_ticks(sim, 2);
  sim.join("robot", "guest", "r");
  sim.set_row("robot/guest/pose", {2, 0, 0, 1, 0, 0, 0});
  run_ticks(sim, 2);
  EXPECT_NEAR(pictures(sim).at(0).at(160, 119), 1.9, 0.05);
}

TEST_F(Camera, TakesPicturesAtItsRateAndRanges) {
  Simulation sim = run("z='1' rate='4' width='64' height='48' min_range='2' max_range='6'");
  int taken = 0;
  for (int i = 0; i < 40; ++i) {
    sim.step();
    for (const Picture& each : pictures(sim)) {
      ++taken;
      EXPECT_EQ(each.depth.size(), 64u * 48u);
      EXPECT_TRUE(std::isinf(each.at(32, 47)) && each.at(32, 47) < 0);  // the ground, 1.5 m away
    }
  }
  EXPECT_EQ(taken, 8);
  const Picture far = after(4, "z='1' max_range='4'");
  EXPECT_TRUE(std::isinf(far.at(160, 100)) && far.at(160, 100) > 0);
}

TEST_F(Camera, LooksWhereItIsTurned) {
  const Picture down = after(2, "z='2' pitch='1.5707963'");
  EXPECT_NEAR(down.at(160, 120), 2, 1e-6);
  EXPECT_NEAR(down.at(5, 5), 2, 1e-6);
  const Picture left = after(2, "z='1' yaw='0.5'");
  EXPECT_NEAR(left.at(160, 119), 4.95 / std::cos(0.5), 0.02);
}

// depth_noise z^2, in all pixels of a wall; a colour's noise in all of the sky.
TEST_F(Camera, NoiseIsAsDeclared) {
  const Picture noisy = after(2, "z='1' depth_noise='0.002' noise='0.02'"), clean = after(2, "z='1'");
  double sum = 0, squares = 0, n = 0, colours = 0;
  for (int y = 60; y < 130; ++y) {
    for (int x = 20; x < 300; ++x) {
      const double off = noisy.at(x, y) - clean.at(x, y);
      sum += off, squares += off * off, ++n;
      colours += std::pow((noisy.red(x, y) - clean.red(x, y)) / 255.0, 2);
    }
  }
  const double sd = 0.002 * 4.95 * 4.95;
  EXPECT_NEAR(sum / n, 0, 5 * sd / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), sd, 5 * sd / std::sqrt(2 * n));
  EXPECT_NEAR(std::sqrt(colours / n), 0.02, 0.001);
}

TEST_F(Camera, AMeshIsSeen) {
  folder.write(
      "block.obj",
      "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\nv -0.5 -0.5 2\nv 0.5 -0.5 2\nv 0.5 0.5 2\n"
      "v -0.5 0.5 2\nf 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\n"
      "f 4 1 5\nf 4 5 8\n");
  const Picture seen = after(2, "z='1'", "<mesh name='m' file='block.obj' at='3 0 0' material='brick'/>");
  EXPECT_NEAR(seen.at(160, 119), 2.5, 1e-6);
}

TEST_F(Camera, ARecordAsTextHasThePicturesSize) {
  Simulation sim = run("");
  Recorder recorder(sim, {{"image/*/message", 1, {}}}, folder / "out");
  run_ticks(sim, 2);
  recorder.write(sim);
  const auto files = recorder.close();
  ASSERT_EQ(files.size(), 1u);
  std::ifstream in(files[0]);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find(",307200 bytes,230400 bytes\n"), text.npos) << text.substr(0, 200);
}

TEST_F(Camera, ARunIsTheSameAgain) {
  const std::string inside = pictured +
                             "<robots.drive/><control.steady robot='r' v='0.3' w='0.2'/><sensors.camera name='c' "
                             "robot='r' width='40' height='30' noise='0.1' depth_noise='0.01'/>";
  expect_one_run([&] { return world_in(folder, inside); }, "c");
}

}  // namespace
