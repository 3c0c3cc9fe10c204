// The measured samples as rows, in the place of whatever would take them.
#include "samples.hpp"

namespace {

using namespace muster;

struct DataSamples {
  static constexpr auto id = "data.samples/1", summary = "lists the samples of a measured table";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {file("file", "t[s],thermometer").required()};
  explicit DataSamples(Setup& s) : measured(s.file<Sample>("file")), at(s.write<Sample>("sample/*/at")) {}
  void step(const Step& k) const {
    const auto out = k.append(at, k[measured].size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = k[measured][i];
  }
  In<Sample> measured;
  Out<Sample> at;
};

}  // namespace

MUSTER_PLUGIN_IS(DataSamples)
