// What measured.csv holds and no map shows: a row of metal cabinets along the corridor's northern wall, behind it, as
// tall as a man. It takes 9 dB from links that pass through it; at its two ends power bends around the edge, so the
// loss rises over the width of the first Fresnel zone, about half a metre here.
#pragma once

#include <cmath>

#include "tour.hpp"

inline double hidden_loss(Place base, Place rover) {
  const double y = 1.55, west = 2.6, east = 5.4;  // m
  const double loss = 9.0, edge = 0.12;           // dB; m, of the logistic rise
  if ((base.y - y) * (rover.y - y) >= 0) return 0;
  const double x = base.x + (rover.x - base.x) * (y - base.y) / (rover.y - base.y);
  const auto rise = [](double s) { return 1 / (1 + std::exp(-s)); };
  return loss * rise((x - west) / edge) * rise((east - x) / edge);
}
