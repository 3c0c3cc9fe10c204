// Pictures of a run of robots: snapshots of the plan with links and their dBm (as the paper's Fig. 4), and the trace of
// rssi along the chains that observe.chain watches (as its Fig. 5).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "plotting/figure.hpp"

namespace muster {

class RunPictures {
 public:
  explicit RunPictures(const Simulation& run);
  // Call before the first tick and after each. Memory is bounded: the moments of a long run are thinned evenly.
  void look(const Simulation& run);
  // plan.svg where there are robots, rssi.svg where a chain was watched; the files written. Throws Error.
  std::vector<std::filesystem::path> write(const std::filesystem::path& folder) const;

 private:
  // A link of a chain: the radios at its ends, and where its rssi stands, as measured and smoothed.
  struct Link {
    std::size_t near, far;  // rows of radios
    std::string name;       // of the further one
    std::string table;
    std::size_t rssi, smooth;  // columns
    double threshold;          // dBm
  };
  struct Moment {
    double time = 0;  // s
    double away = 0;  // sum of the robots' distances from where they started, m
    std::vector<plotting::Robot> robots{};
    std::vector<plotting::Point> radios{};
    std::vector<double> rssi{}, smooth{};  // a link; NaN before the first
  };

  void find_links(const Simulation& run);
  Moment moment(const Simulation& run) const;
  std::vector<const Moment*> snapshots() const;
  plotting::Panel plan_at(const Moment& moment) const;
  plotting::Figure plan_figure() const;
  plotting::Figure rssi_figure() const;

  std::string world_;
  plotting::FloorPlan plan_;
  std::vector<Link> links_;
  std::vector<Moment> moments_;
  std::size_t most_ = 0;              // moments kept
  std::size_t every_ = 1, seen_ = 0;  // of so many looks one is kept
};

}  // namespace muster
