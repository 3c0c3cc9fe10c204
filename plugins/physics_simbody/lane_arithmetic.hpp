// Eight contacts at a time, as loops over lanes that compilers vectorise. Part of block_kernel.cpp, and internal to it.
#pragma once

#include "contact_lanes.hpp"

namespace muster::simbody {
namespace {

struct Lanes {
  static constexpr int width = ContactLanes::width;
  static constexpr double least = 1e-300;  // of divisors

  static double larger(double a, double b) { return a > b ? a : b; }

  static void respond(ContactLanes* contacts, int count) {
    for (int i = 0; i < count; ++i) {
      ContactLanes& c = contacts[i];
      for (int k = 0; k < width; ++k) {
        const double lacks = c.target[k] - c.speed[k];
        c.push[k] = larger(0, lacks * c.hardness[k]);
        c.stiffness[k] = lacks > 0 ? c.hardness[k] : 0;
        const double x = c.slip[0][k], y = c.slip[1][k], square = x * x + y * y;
        const double size = __builtin_sqrt(square), sticking = c.grip_softness[k] * c.bound[k];
        const double inverse = 1 / larger(larger(size, sticking), least), stiffness = c.bound[k] * inverse;
        const double turn = size > sticking ? inverse * inverse : 0;
        c.grip[0][k] = -stiffness * x;
        c.grip[1][k] = -stiffness * y;
        // Half of the product of dual and slip, and half of its mirror image, so that the Hessian stays symmetric.
        c.grip_xx[k] = stiffness + turn * (c.dual[0][k] * x);
        c.grip_xy[k] = 0.5 * turn * (c.dual[0][k] * y + c.dual[1][k] * x);
        c.grip_yy[k] = stiffness + turn * (c.dual[1][k] * y);
      }
    }
  }

  static void move_duals(ContactLanes* contacts, int count) {
    for (int i = 0; i < count; ++i) {
      ContactLanes& c = contacts[i];
      for (int k = 0; k < width; ++k) {
        const double x = c.slip[0][k], y = c.slip[1][k], dx = c.slip_ahead[0][k], dy = c.slip_ahead[1][k];
        const double size = __builtin_sqrt(x * x + y * y), sticking = c.grip_softness[k] * c.bound[k];
        const double inverse = 1 / larger(larger(size, sticking), least), stiffness = c.bound[k] * inverse;
        const double turn = size > sticking ? inverse * inverse * (x * dx + y * dy) : 0;
        const double to_x = -stiffness * (x + dx) - turn * c.dual[0][k];
        const double to_y = -stiffness * (y + dy) - turn * c.dual[1][k];
        const double length = __builtin_sqrt(to_x * to_x + to_y * to_y);
        const double share = length > c.bound[k] ? c.bound[k] / length : 1;
        c.dual[0][k] = share * to_x;
        c.dual[1][k] = share * to_y;
      }
    }
  }

  static double slope(const ContactLanes* contacts, int count, double a) {
    double sums[width] = {};
    for (int i = 0; i < count; ++i) {
      const ContactLanes& c = contacts[i];
      for (int k = 0; k < width; ++k) {
        const double x = c.slip[0][k] + a * c.slip_ahead[0][k], y = c.slip[1][k] + a * c.slip_ahead[1][k];
        const double size = __builtin_sqrt(x * x + y * y), sticking = c.grip_softness[k] * c.bound[k];
        const double stiffness = c.bound[k] / larger(larger(size, sticking), least);
        const double push = larger(0, (c.target[k] - c.speed[k] - a * c.speed_ahead[k]) * c.hardness[k]);
        sums[k] += push * c.speed_ahead[k] - stiffness * (x * c.slip_ahead[0][k] + y * c.slip_ahead[1][k]);
      }
    }
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum;
  }

  static void go_ahead(ContactLanes* contacts, int count, double a) {
    for (int i = 0; i < count; ++i) {
      ContactLanes& c = contacts[i];
      for (int k = 0; k < width; ++k) {
        c.speed[k] += a * c.speed_ahead[k];
        c.slip[0][k] += a * c.slip_ahead[0][k];
        c.slip[1][k] += a * c.slip_ahead[1][k];
      }
    }
  }

  static constexpr LaneArithmetic all = {respond, move_duals, slope, go_ahead};
};

}  // namespace
}  // namespace muster::simbody
