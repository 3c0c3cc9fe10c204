// A controller that wants to know more than its robot senses.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestPeeker {
  static constexpr auto id = "test.peeker/1";
  static constexpr auto summary = "claims a table";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it steers").required(),
                                     text("table", "", "the table it reads").required(),
                                     text("columns", "", "the table's columns").required()};

  explicit TestPeeker(Setup& s) {
    if (s.host()->claim(s.host(), MUSTER_READ, 0, s.text("table").c_str(), s.text("columns").c_str()) < 0)
      throw std::runtime_error("");
  }
  void step(const Step&) const {}
};

}  // namespace

MUSTER_PLUGIN_IS(TestPeeker)
