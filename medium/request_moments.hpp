// When the requests of a tick are made: each radio's at random moments of its own, whoever else asks for anything.
#pragma once

#include <cstdint>
#include <muster/plugin.hpp>
#include <vector>

namespace muster::medium {

class RequestMoments {
 public:
  // A network declares this flag.
  static constexpr Param spread_param = flag("spread", true, "requests come at any moment of their tick");

  explicit RequestMoments(Setup& s) : spread_(s.value("spread")), stream_(s.stream("moments of requests")) {}

  // Begins a tick.
  void start(std::size_t radios) { made_.assign(radios, 0); }
  // Moment [s] of the radio's next request in this tick.
  double next(const Step& k, std::size_t radio) {
    const double share = k[spread_] != 0 ? stream_.of(k.key("radio", radio)).uniform(k.tick(), made_[radio]++) : 0;
    return k.time() - (1 - share) * k.dt();
  }

 private:
  Value spread_;
  Stream stream_;
  std::vector<std::uint64_t> made_;  // requests in this tick
};

}  // namespace muster::medium
