// Shadowing by the places of the two ends alone, for comparison with a field over the space between them.
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <vector>

#include "per_end_field.hpp"

namespace {

using namespace muster;

struct RadioGudmundson {
  static constexpr auto id = "radio.gudmundson/1";
  static constexpr auto summary =
      "shadowing that decorrelates as each end moves, whatever lies between (Gudmundson 1991)";
  static constexpr auto manual =
      R"(Normal in dB with standard deviation `shadowing` at any length, correlated as exp(-a/D) exp(-b/D) when one end
of a link moves by a and the other by b, D = decorrelation. The same both ways and on return; a function of seed
and places. For comparison: it gives radios side by side the whole shadowing, and links that cross none in
common, where radio.fading has what lies on the way. Of two links with lengths d1 and d2 both pairings of their ends
count: (p + q) / sqrt((1 + exp(-2 d1/D)) (1 + exp(-2 d2/D))), p and q being that product for each. With radio.fading
shadowing="0" beside it, that one's fading. Asked for expectations it is 0.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("shadowing", 4, 0, 30, "dB", "standard deviation"),
      real("decorrelation", 2, 0.01, 1e4, "m",
           "way of one end over which correlation falls to 1/e; only with shadowing"),
  };

  static void covariance(const double* params, const double* ends, const uint32_t* a, const uint32_t* b, uint32_t count,
                         double* out) {
    const double variance = params[0] * params[0], unit = params[1];
    const auto end = [&](uint32_t link, int which) {
      const double* at = ends + std::size_t{6} * link + std::ptrdiff_t{3} * which;
      return PerEndField::Place{at[0] / unit, at[1] / unit, at[2] / unit};
    };
    for (uint32_t i = 0; i < count; ++i)
      out[i] = variance * PerEndField::correlation(end(a[i], 0), end(a[i], 1), end(b[i], 0), end(b[i], 1));
  }
  static constexpr muster_draw draw{sizeof(muster_draw), "shadowing", "decorrelation", covariance};

  explicit RadioGudmundson(Setup& s)
      : sd(s.value("shadowing")),
        decorrelation(s.value("decorrelation")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")),
        field(s.stream("shadowing")) {}

  void step(const Step& k) const {
    const auto links = k[ends];
    const auto out = k[level];
    if (k.expected()) {
      for (Level& link : out) link.level = 0;
      return;
    }
    std::vector<PerEndField::End> at;
    for (const Pose& p : k[pose]) {
      const double unit = k[decorrelation];
      at.push_back(field.end_at(p.x / unit, p.y / unit, p.z / unit));
    }
    const auto back = earlier_reverse(links, at.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const auto tx = static_cast<std::size_t>(links[i].tx), rx = static_cast<std::size_t>(links[i].rx);
      out[i].level = back[i] != no_link ? out[back[i]].level : k[sd] * PerEndField::between(at[tx], at[rx]);
    }
  }

  Value sd, decorrelation;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
  PerEndField field;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioGudmundson)
