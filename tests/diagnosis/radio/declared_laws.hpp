// Laws of readings as the shipped causes declare them.
#pragma once

#include <map>

#include "diagnosis/radio/laws/reading_distribution.hpp"

namespace muster::diagnosis {

inline std::shared_ptr<const ReadingLaw> declared_law(const std::string& id) {
  static std::map<std::string, std::shared_ptr<const ReadingLaw>> known;
  auto& law = known[id];
  if (!law) {
    const auto library = Library::load(id, {}, {MUSTER_PLUGINS_DIR}, {"test"});
    law = std::make_shared<const ReadingLaw>(id, library, library->plugins().back());
  }
  return law;
}

inline const std::vector<std::shared_ptr<const ReadingLaw>> shipped_laws = {
    declared_law("effect.channel_mixture"), declared_law("effect.fading_law"), declared_law("effect.outliers")};

struct Scatter {
  double rician_k = 60;                  // dB
  double outliers = 0, half_width = 20;  // share; dB
  double channel_sd = 0, channels = 3;   // dB
};

inline ReadingDistribution law_of(const Scatter& s) {
  ReadingDistribution result{{declared_law("effect.fading_law"), {s.rician_k}}};
  if (s.outliers > 0) result.added.push_back({declared_law("effect.outliers"), {s.outliers, s.half_width}});
  if (s.channel_sd > 0) result.added.push_back({declared_law("effect.channel_mixture"), {s.channel_sd, s.channels}});
  return result;
}

}  // namespace muster::diagnosis
