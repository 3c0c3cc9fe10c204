// An instance whose steps run in a process of its own. The plugin's state is in tables, so that a step needs the tables
// that it reads, and all that it does is in those that it writes: these cross by shared memory, with the instance's
// parameters and what it says. The instance made here never steps itself: each process begins as a copy of it.
#pragma once

#include <muster/plugin.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "instance.hpp"
#include "separate_process.hpp"

namespace muster {

class IsolatedStep final : public Elsewhere {
 public:
  // For an instance with isolation().
  IsolatedStep(Instance& instance, Surroundings& around);

  bool run(const muster_tick& now) override;
  void start_anew() override { process_.reset(); }
  bool is_given_up() const override { return given_up_; }
  void give_up(bool given_up) override { given_up_ = given_up; }

 private:
  class Crossing;
  void start();
  void serve(std::byte* memory);
  bool knows_the_sets() const;
  bool goes_on(const muster_tick& now, const std::string& how);
  void keep_values();

  Instance& instance_;
  Surroundings& around_;
  Isolation how_;
  std::size_t bytes_;
  std::vector<std::pair<const Set*, std::vector<uint8_t>>> sets_;  // as the process knows them, and whose rows live
  std::unique_ptr<SeparateProcess> process_;
  bool given_up_ = false;
  uint64_t restarted_at_ = UINT64_MAX;  // the tick
};

}  // namespace muster
