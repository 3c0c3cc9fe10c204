#include "pacing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace muster::cli {
namespace {

constexpr double slice = 0.05;  // [s] after which a sleeper looks whether the run is to end
constexpr double slack = 0.02;  // [s] late that nobody sees: some switches between programs of a busy computer

}  // namespace

double SteadyClock::now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void SteadyClock::sleep_until(double moment) {
  for (double left = moment - now(); left > 0 && !is_over_(); left = moment - now())
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, slice)));
}

void Pacing::restart(double speed, double time) {
  speed_ = speed;
  time_ = time;
  began_ = clock_.now();
}

void Pacing::wait(double time) {
  const double due = began_ + (time - time_) / speed_, now = clock_.now();
  late_ = std::max(0.0, now - due);
  most_late_ = std::max(most_late_, late_);
  if (now < due) clock_.sleep_until(due);
}

std::string Pacing::warning(double dt) const {
  if (most_late_ <= std::max(slack, dt / speed_)) return "";
  return fmt::format("not in real time: this computer was up to {:.3g} s late at --speed {:.6g}, {:.3g} s at the end",
                     most_late_, speed_, late_);
}

}  // namespace muster::cli
