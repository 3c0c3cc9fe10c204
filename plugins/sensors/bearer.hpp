// The robots that carry a sensor: the one that its instance names, or all that no other instance names.
#pragma once

#include <muster/plugin.hpp>
#include <string>

namespace muster {

constexpr Param bearer_param() {
  return reference("robot", "robot", "whose sensor; by default of all without their own");
}

class Bearer {
 public:
  explicit Bearer(const Setup& setup) : row_(setup.param("robot")) {}

  // A table of its robots, and the flags of a write of it.
  std::string table(const std::string& quantity) const {
    return "robot/" + std::string(row_ < 0 ? "*" : "{robot}") + '/' + quantity;
  }
  uint32_t flags() const { return row_ < 0 ? MUSTER_REST : 0; }
  // The robot of a row of such a table.
  std::size_t robot_of(std::size_t row) const { return row_ < 0 ? row : static_cast<std::size_t>(row_); }
  bool is_of_one() const { return row_ >= 0; }

 private:
  double row_;
};

}  // namespace muster
