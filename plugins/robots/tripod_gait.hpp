// The alternating tripod gait of a robot on half-circle legs: Buehler's clock (Saranli, Buehler, Koditschek, IJRR
// 20(7), 2001), and the stride of a robot whose rigid legs roll without slip, one tripod always on the ground.
//
// With the leg at angle x behind upright the hip is 2 r cos x over the ground while the leg is on its end (x >= 0). It
// is r (1 + cos x) while the leg rolls on its arc (x <= 0). Both tripods turn alike in their stances, half a cycle
// apart: the one with the higher hip carries the body. So the load changes legs where 2 cos a = 1 + cos b, a in front
// of the new leg's b by half a cycle's turn.
#pragma once

#include <cmath>

namespace muster {

constexpr double whole_turn = 6.283185307179586;  // [rad]

// Angle of a leg, from upright. `phase` in cycles, a stance is centred at 0 and takes the share `duty` of a cycle, in
// which the leg turns slowly by `sweep` [rad]; in the rest it completes a whole turn. A negative sweep walks backwards.
// At phases 0 and 1/2 the angle is the same for every sweep, but for whole turns.
inline double clock_angle(double phase, double sweep, double duty) {
  phase -= std::round(phase);
  const double in_stance = std::abs(phase) <= duty / 2 ? phase : std::copysign(duty / 2, phase);
  const double swing = std::copysign(whole_turn, sweep) - sweep;  // what is left of the turn
  return sweep * in_stance / duty + swing * (phase - in_stance) / (1 - duty);
}

// Half a cycle of the gait, by the angle at which a leg takes over the load: `before` upright on its arc, while the
// other one is `behind` upright on its end [rad].
struct Handover {
  explicit Handover(double angle)
      : before(angle), behind(std::acos((1 + std::cos(angle)) / 2)), sine(std::sin(behind)) {}
  // Path of the body in radii of the leg.
  double way() const { return before + std::sin(before) + 2 * sine; }
  // Turn of a leg in half a cycle [rad].
  double turn() const { return before + behind; }

  double before, behind, sine;
};

// The handover at which `measure`, which rises with the angle, has the given value.
template <class Measure>
Handover handover_where(double value, Measure measure) {
  double low = 0, high = 1.5;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (measure(Handover(middle)) < value ? low : high) = middle;
  }
  return Handover((low + high) / 2);
}

// Path of the body in a whole cycle [m].
inline double stride_of(double sweep, double duty, double radius) {
  const double half = std::abs(sweep) / (2 * duty);
  const Handover at = handover_where(half, [](const Handover& h) { return h.turn(); });
  return std::copysign(2 * radius * at.way(), sweep);
}

// The sweep of a stride [rad].
inline double sweep_of(double stride, double duty, double radius) {
  const double half = std::abs(stride) / (2 * radius);
  const Handover at = handover_where(half, [](const Handover& h) { return h.way(); });
  return std::copysign(2 * duty * at.turn(), stride);
}

}  // namespace muster
