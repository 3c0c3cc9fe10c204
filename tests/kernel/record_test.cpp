// Records: a plugin reads back the CSV that was written.
#include "kernel/record.hpp"

#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Records = ToyWorld;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Records, ATableIsReadBackBitByBit) {
  Simulation sim = run(
      two_robots + "<toy.copy_physics name='n' to='robot/*/place' columns='x[m]' own='true' times='1.1' add='0.1'/>\n");
  Recorder recorder(sim, {{"robot/*/place", 1, {}}}, folder / "out");
  std::vector<double> sums(2, 0);
  for (int i = 0; i < 20; ++i) {
    step(sim);
    recorder.write(sim);
    for (std::size_t r = 0; r < 2; ++r) sums[r] += cell(sim, "robot/*/place", 0, r);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out/robot_place.csv"));
  EXPECT_THAT(recorder.close(), ElementsAre(folder / "out/robot_place.csv"));
  Simulation reader = run(two_robots + "<toy.file name='f' data='out/robot_place.csv'/>\n");
  step(reader);
  EXPECT_TRUE(same_bits(cell(reader, "robot/a/total"), sums[0]));
  EXPECT_TRUE(same_bits(cell(reader, "robot/b/total"), sums[1]));
  EXPECT_EQ(cell(reader, "robot/b/total", 1), 20);
}

TEST_F(Records, EveryKindOfColumn) {
  Simulation sim = run(two_robots + "<toy.kinds name='k' mark='A'/>\n");
  Recorder recorder(sim, {{"robot/*/kinds", 2, {}}, {"robot/b/kinds", 1, {}}}, folder);
  for (int i = 0; i < 3; ++i) step(sim), recorder.write(sim);
  recorder.close();
  EXPECT_EQ(bytes_of(folder / "robot_kinds.csv"),
            "t[s],robot,range0[m],range1[m],range2[m],rssi[dBm],mate,image\n"
            "1,a,1,inf,-inf,-60,,\"4120322e30\"\n"
            "1,b,1,inf,-inf,,a,\n");
  EXPECT_EQ(bytes_of(folder / "robot_b_kinds.csv"),
            "t[s],robot,range0[m],range1[m],range2[m],rssi[dBm],mate,image\n"
            "0.5,b,1,inf,-inf,-60,,\"4120312e31\"\n"
            "1,b,1,inf,-inf,,a,\n"
            "1.5,b,1,inf,-inf,-60,,\"4120332e31\"\n");
}

TEST_F(Records, NoNameStandsTwiceInAHeader) {
  Simulation sim =
      run(two_robots + "<toy.copy_physics name='n' to='robot/*/place' columns='t[s] robot x[m]' own='true'/>\n");
  Recorder(sim, {{"robot/*/place", 1, {}}}, folder).close();
  EXPECT_EQ(bytes_of(folder / "robot_place.csv"), "t[s],robot,robot_t[s],robot_robot,x[m]\n");
}

TEST_F(Records, EachMessageOnceWhateverThePeriod) {
  Simulation sim = run(two_robots +
                       "<toy.send_control name='s' robot='b' to='outbox/{robot}/message' "
                       "every='2'/>\n<toy.listen_control name='l' every='8'/>\n");
  Recorder recorder(sim, {{"outbox/*/message", 4, {}}}, folder);
  for (int i = 0; i < 4; ++i) step(sim), recorder.write(sim);
  recorder.close();
  EXPECT_THAT(bytes_of(folder / "outbox_message.csv"),
              testing::MatchesRegex("t\\[s\\],outbox,radio,to,payload\n1,.*,b,,3230307c\n2,.*,b,,3430307c\n"));
}

TEST_F(Records, WhatIsNotThereIsRefusedWhereItIsAskedFor) {
  World text =
      world(two_robots + "<toy.copy_physics name='n' to='robot/*/place'/>\n<record table='robot/*/plaice'/>\n");
  const auto declared = text.records;
  Simulation sim(std::move(text), standard(), options());
  EXPECT_EQ(error_of([&] { Recorder(sim, declared, folder); }),
            "world.xml:5:1: record: there is no table \"robot/*/plaice\"; expected one of robot/*/drive, "
            "robot/*/gait, robot/*/geometry, robot/*/gps, robot/*/imu, robot/*/legs, robot/*/odometry, robot/*/place, "
            "robot/*/pose, "
            "robot/*/position3d, robot/*/rotor_drive, robot/*/rotors, robot/*/stall, robot/*/twist, robot/*/wheels; "
            "did you mean \"robot/*/place\"?");
  EXPECT_THAT(error_of([&] {
                Recorder(sim, {{"robot/c/place", 1, {}}}, folder);
              }),
              HasSubstr("there is no robot \"c\"; expected one of a, b"));
}

TEST_F(Records, WithoutCloseOnlyWhatWasFlushedRemains) {
  Simulation sim = run(two_robots + "<toy.copy_physics name='n' to='robot/*/place'/>\n");
  {
    Recorder recorder(sim, {{"robot/*/place", 1, {}}}, folder / "out");
    step(sim), recorder.write(sim);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
  {
    Recorder recorder(sim, {{"robot/*/place", 1, {}}}, folder / "out");
    step(sim), recorder.write(sim), recorder.flush();
  }
  EXPECT_GT(std::filesystem::file_size(folder / "out/robot_place.csv.part"), 0u);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/robot_place.csv"));
}

}  // namespace
}  // namespace muster
