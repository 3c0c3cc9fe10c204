// Sums a file's table by robot.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Measured {
  static constexpr const char* columns = "t[s]? robot:robot x[m]";
  double t, robot, x;
};
struct Total {
  static constexpr const char* columns = "x[m] rows untimed";
  double x, rows, untimed;
};

struct ToyFile {
  static constexpr auto id = "toy.file/1", summary = "sums a file";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {file("data", "rows of t[s],robot,x[m]")};

  explicit ToyFile(Setup& s) : in(s.file<Measured>("data")), out(s.write<Total>("robot/*/total")) {}

  void step(const Step& k) const {
    for (auto& row : k[out]) row = {0, 0, 0};
    for (const auto& row : k[in]) {
      Total& to = k[out][static_cast<std::size_t>(row.robot)];
      to = {to.x + row.x, to.rows + 1, to.untimed + (is_null(row.t) ? 1 : 0)};
    }
  }

  In<Measured> in;
  Out<Total> out;
};

}  // namespace

MUSTER_PLUGIN_IS(ToyFile)
