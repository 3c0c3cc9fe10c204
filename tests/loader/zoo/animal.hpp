// A plugin that does nothing, to be spoilt in one way by each file of the zoo.
#pragma once

#include <muster/plugin.hpp>

struct Animal {
  static constexpr auto id = ANIMAL_ID;
  static constexpr auto summary = "does nothing";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr muster::Param params[] = {muster::real("size", 1, 0, 10, "m", "how tall it is").free()};

  explicit Animal(muster::Setup& setup) : size(setup.value("size")) {}
  void step(const muster::Step&) const {}

  muster::Value size;
};
