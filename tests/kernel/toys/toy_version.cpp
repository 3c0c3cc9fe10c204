// Writes the version that it was built as; built twice, to be reloaded.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Written {
  static constexpr const char* columns = "version steps";
  double version, steps;
};

struct Version {
  static constexpr auto id = "toy.version/1", summary = "writes its version";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {real("offset", 0, -10, 10, "", "added to the version")};

  explicit Version(Setup& s) : offset(s.value("offset")), out(s.write<Written>("self/version")) {}
  void step(const Step& k) const { *k[out] = {TOY_VERSION + k[offset], k.last(out)->steps + 1}; }

  Value offset;
  Out<Written> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Version)
