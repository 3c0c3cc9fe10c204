// A reading with noise: a draw for each row and tick, or its expectation on request.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Reading {
  static constexpr const char* columns = "reading[m]";
  double reading;
};

struct Draw {
  static constexpr auto id = "toy.draw/1", summary = "draws a reading for each robot";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {real("mean", 2, -100, 100, "m", "mean of the reading").free(),
                                     text("stream", "noise", "the stream")};

  explicit Draw(Setup& s)
      : mean(s.value("mean")),
        noise(s.stream(s.text("stream").c_str())),
        out(s.write<Reading>("robot/*/reading", MUSTER_SENSED)) {}

  void step(const Step& k) const {
    const auto rows = k[out];
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].reading = k[mean] + (k.expected() ? 0.0 : noise.of(k.key("robot", i)).normal(k.tick()));
  }

  Value mean;
  Stream noise;
  Out<Reading> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Draw)
