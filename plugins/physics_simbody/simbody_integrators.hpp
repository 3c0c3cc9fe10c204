// Simbody's own integrators as reference: rolling constraints, wheels that turn as commanded. Each robot is a system of
// its own (dense algebra). Each tick starts anew from the given state, since an integrator's history cannot be restored
// to the same bits.
#pragma once

#include "engine.hpp"
#include "model.hpp"

namespace muster::simbody {

class SimbodyIntegrators : public Engine {
 public:
  SimbodyIntegrators(const std::vector<NamedRobot>& robots, Integrator integrator, double step);
  ~SimbodyIntegrators() override;
  void step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states,
            const Each& each = one_by_one) override;

 private:
  struct Robot;
  std::vector<std::unique_ptr<Robot>> robots_;
  Integrator integrator_;
  double step_;
};

}  // namespace muster::simbody
