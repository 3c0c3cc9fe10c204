// The exam's hidden effects against the simulator's: two formulas for each, at the same parameters.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "diagnosis/radio/links/link_model.hpp"
#include "exam/files.hpp"
#include "made.hpp"
#include "tests/folder.hpp"

namespace muster {
namespace {

namespace fs = std::filesystem;

// The effect of an answer as a world element, for parameters named as the plugin's.
std::string element_of(const exam::Hidden& hidden) {
  std::string out = "<effect." + hidden.effect.id;
  for (const std::string& row : hidden.effect.rows)
    out += " " + row.substr(0, row.find('/')) + "=\"" + row.substr(row.find('/') + 1) + "\"";
  for (const exam::Parameter& p : hidden.effect.parameters(hidden.strength))
    out += fmt::format(" {}=\"{}\"", p.name, p.value);
  return out + "/>\n</world>";
}

// dB that the simulator adds to each reading for it.
Eigen::VectorXd executed(const exam::Case& c) {
  const test::Folder folder;
  exam::write_case(c, folder.path());
  const Library::SearchPath plugins({fs::path(MUSTER_PLUGINS_DIR)});
  const fs::path world = folder / (c.name + "/world.xml"), data = folder / (c.name + "/measured.csv");
  std::string text = exam::read_file(world);
  text.replace(text.find("</world>"), 8, element_of(c.hidden[0]));
  const fs::path extended = folder.write(c.name + "/extended.xml", text);
  diagnosis::LinkModel with(extended, data, plugins), without(world, data, plugins);
  return with.expected() - without.expected();
}

class Executed : public testing::TestWithParam<const char*> {};

TEST_P(Executed, IsWhatTheExamHides) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 8u, 23u}) {  // 8, 23: an obstacle under stations at the ceiling
    const exam::Case c = exam::made(seed, GetParam(), 60, 600);
    const Eigen::VectorXd hidden = exam::expected_shift(*c.site, c.hidden, c.measured);
    const Eigen::VectorXd done = executed(c);
    ASSERT_EQ(done.size(), hidden.size());
    EXPECT_GT(done.dot(hidden), 0.98 * done.norm() * hidden.norm()) << seed;
    EXPECT_NEAR(done.norm() / hidden.norm(), 1, 0.1) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, Executed,
                         testing::Values("unmapped_wall", "obstacle", "two_ray", "dual_slope", "tx_offset", "rx_offset",
                                         "step"),
                         [](const auto& i) { return std::string(i.param); });

}  // namespace
}  // namespace muster
