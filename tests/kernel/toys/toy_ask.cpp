// Queries two sets by turns, within a step: the number of rows of each and their names.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Asked {
  static constexpr const char* columns = "robots materials unknown robot material endpoints";  // counts, first letters
  double robots, materials, unknown, robot, material, endpoints;
};

struct Ask {
  static constexpr auto id = "toy.ask/1", summary = "what the host says of two sets";
  static constexpr auto phase = MUSTER_SENSE;

  explicit Ask(Setup& s) : out(s.write<Asked>("robot/*/asked")) {}

  void step(const Step& k) const {
    const auto rows = k[out];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].robots = k.rows("robot");
      rows[i].materials = k.rows("material");
      rows[i].unknown = k.rows("no such set");
      rows[i].robot = k.name("robot", i).at(0);
      rows[i].material = k.name("material", i).at(0);
      rows[i].endpoints = k.rows("endpoint");
    }
  }

  Out<Asked> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Ask)
