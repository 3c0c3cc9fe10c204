// Lists all radios and all pairs of them, forward or backward: terms must not depend on the order.
#include <muster/plugin.hpp>
#include <vector>

namespace {

using namespace muster;

struct Links {
  static constexpr auto id = "conformance.links/1", summary = "all pairs, in either order";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {flag("backward", false, "the last sender first")};

  explicit Links(Setup& s)
      : backward(s.value("backward")),
        mount(s.read<Mount>("radio/*/mount")),
        radio(s.write<Endpoint>("endpoint/*/radio")),
        pose(s.write<Pose>("endpoint/*/pose")),
        ends(s.write<Ends>("link/*/ends")) {}

  void step(const Step& k) const {
    const auto mounts = k[mount];
    const auto radios = k.append(radio, mounts.size());
    const auto poses = k.append(pose, mounts.size());
    std::vector<Ends> pairs;
    for (std::size_t a = 0; a < mounts.size(); ++a) {
      radios[a] = {static_cast<double>(a), k.time()};
      poses[a] = {mounts[a].x * (1 + k.time() / 64), mounts[a].y, mounts[a].z, 1, 0, 0, 0};  // they drift apart
      for (std::size_t b = 0; b < mounts.size(); ++b) {
        if (a != b) pairs.push_back({static_cast<double>(a), static_cast<double>(b)});
      }
    }
    const auto links = k.append(ends, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) links[i] = pairs[k[backward] != 0 ? pairs.size() - 1 - i : i];
  }

  Value backward;
  In<Mount> mount;
  Out<Endpoint> radio;
  Out<Pose> pose;
  Out<Ends> ends;
};

}  // namespace

MUSTER_PLUGIN_IS(Links)
