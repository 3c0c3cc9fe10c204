// Writes the version that it was built as; built twice, to be reloaded.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Written {
  static constexpr const char* columns = "version steps bias mode";
  double version, steps, bias, mode;
};
constexpr bool is_first = TOY_VERSION == 1;

struct Version {
  static constexpr auto id = "toy.version/1", summary = "writes its version";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      real("offset", 0, -10, 10, "", "added to the version"),
      real("bias", is_first ? 1 : 2, is_first ? -10 : 0, 10, "", "of another default and range in the second"),
      choice("mode", is_first ? "slow|fast|odd" : "off|slow|fast", "of other words in the second"),
  };

  explicit Version(Setup& s)
      : offset(s.value("offset")),
        bias(s.value("bias")),
        mode(s.value("mode")),
        out(s.write<Written>("self/version")) {}
  void step(const Step& k) const { *k[out] = {TOY_VERSION + k[offset], k.last(out)->steps + 1, k[bias], k[mode]}; }

  Value offset, bias, mode;
  Out<Written> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Version)
