#include "diagnosis/data/globe.hpp"

#include <cmath>

#include "text/number.hpp"

namespace muster::diagnosis {

std::string why_no_point(const GeodeticPoint& p) {
  if (!(std::abs(p.latitude) <= 90))
    return print_real(p.latitude) + " is no latitude; expected degrees from -90 to 90, before the longitude";
  if (!(std::abs(p.longitude) <= 360))
    return print_real(p.longitude) + " is no longitude; expected degrees from -180 to 180";
  return "";
}

}  // namespace muster::diagnosis
