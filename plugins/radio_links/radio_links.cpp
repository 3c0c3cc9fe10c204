// Endpoints and links of live radios: an endpoint for every radio, a link for every ordered pair within range.
#include <algorithm>
#include <muster/plugin.hpp>
#include <vector>

#include "mount.hpp"

namespace {

using namespace muster;

struct RadioLinks {
  static constexpr auto id = "radio.links/1";
  static constexpr auto summary = "lists the living radios and the pairs of them within range";
  static constexpr auto manual =
      "Each tick lists an endpoint for every radio that has not left, where its mount puts it, and a link for every\n"
      "ordered pair of endpoints no further apart than `range`, grouped by sender.\n"
      "A pair beyond the range is absent: no term is evaluated for it and nothing is received.\n"
      "A fit and a diagnosis have data.links in its place: readings of pairs beyond the range count as all others.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("range", 1000, 0, 1e6, "m", "pairs further apart than this are absent")};

  explicit RadioLinks(Setup& s)
      : range(s.value("range")),
        mount(s.read<Mount>("radio/*/mount")),
        body(s.read<Pose>("robot/*/pose")),
        endpoint(s.write<Endpoint>("endpoint/*/radio")),
        pose(s.write<Pose>("endpoint/*/pose")),
        ends(s.write<Ends>("link/*/ends")) {}

  void step(const Step& k) const {
    std::vector<Endpoint> radios;
    std::vector<Pose> poses;
    const auto mounts = k[mount];
    for (std::size_t i = 0; i < mounts.size(); ++i) {
      const Mount& on = mounts[i];
      const bool moves = !is_null(on.robot);
      const auto robot = moves ? static_cast<std::size_t>(on.robot) : 0;
      if (!k.alive("radio", i) || (moves && !k.alive("robot", robot))) continue;
      radios.push_back({static_cast<double>(i), k.time()});
      poses.push_back(antenna_in_world(on, moves ? k[body][robot] : Pose{0, 0, 0, 1, 0, 0, 0}));
    }
    const std::vector<Ends> links = pairs(poses, k[range]);
    std::copy(radios.begin(), radios.end(), k.append(endpoint, radios.size()).begin());
    std::copy(poses.begin(), poses.end(), k.append(pose, poses.size()).begin());
    std::copy(links.begin(), links.end(), k.append(ends, links.size()).begin());
  }

  static std::vector<Ends> pairs(const std::vector<Pose>& at, double range) {
    std::vector<Ends> result;
    for (std::size_t a = 0; a < at.size(); ++a) {
      for (std::size_t b = 0; b < at.size(); ++b) {
        const double x = at[a].x - at[b].x, y = at[a].y - at[b].y, z = at[a].z - at[b].z;
        if (a != b && x * x + y * y + z * z <= range * range) {
          result.push_back({static_cast<double>(a), static_cast<double>(b)});
        }
      }
    }
    return result;
  }

  Value range;
  In<Mount> mount;
  In<Pose> body;
  Out<Endpoint> endpoint;
  Out<Pose> pose;
  Out<Ends> ends;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioLinks)
