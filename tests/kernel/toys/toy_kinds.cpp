// Every kind of column at once: numbers that may be absent or infinite, many alike, references, bytes.
#include <limits>
#include <muster/plugin.hpp>
#include <string>

namespace {

using namespace muster;

struct Kinds {
  static constexpr const char* columns = "range[m]*3~ rssi[dBm]? mate:robot? image{}";
  double range[3], rssi, mate, image;
};

struct ToyKinds {
  static constexpr auto id = "toy.kinds/1", summary = "every kind of column";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {reference("robot", "robot", "one row only"),
                                     flag("rest", false, "leave rows to others"),
                                     text("mark", "picture", "what the images say")};

  explicit ToyKinds(Setup& s)
      : mark(s.text("mark")),
        out(s.write<Kinds>(s.param("robot") < 0 ? "robot/*/kinds" : "robot/{robot}/kinds",
                           s.param("rest") != 0 ? MUSTER_REST : 0)) {}

  void step(const Step& k) const {
    const double inf = std::numeric_limits<double>::infinity();
    const auto rows = k[out];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool odd = (k.tick() + i) % 2 == 1;
      rows[i] = {{1, inf, -inf}, odd ? null() : -60.0, odd ? 0.0 : null(), 0};
      if (!odd) k.put_bytes(out, i, 5, mark + ' ' + std::to_string(k.tick()) + '.' + std::to_string(i));
    }
  }

  std::string mark;
  Out<Kinds> out;
};

}  // namespace

MUSTER_PLUGIN_IS(ToyKinds)
