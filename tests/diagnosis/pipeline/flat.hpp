// A flat, a tour of it, and readings that a world draws there.
#pragma once

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "diagnosis/radio/links/link_model.hpp"
#include "tests/diagnosis/pipeline/sealed_case.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {

// A flat of three rooms and three stations. `fading`: attributes; `more`: further elements.
inline std::filesystem::path flat(const Scratch& scratch, int seed, const std::string& fading,
                                  const std::string& more = "") {
  std::ofstream(scratch / "walls.csv") << "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\n"
                                          "south,0,0,14,0,3,0.2,brick\nnorth,0,9,14,9,3,0.2,brick\n"
                                          "west,0,0,0,9,3,0.2,brick\neast,14,0,14,9,3,0.2,brick\n"
                                          "a,5,0,5,6,3,0.1,drywall\nb,5,5,11,5,3,0.1,drywall\n";
  std::filesystem::path world = scratch / "world.xml";
  std::ofstream(world) << "<world name=\"flat\" dt=\"0.1\" until=\"1\" seed=\"" << seed << "\">\n"
                       << "<material name=\"drywall\" loss=\"4\"/><material name=\"brick\" loss=\"9\"/>\n"
                       << "<walls file=\"walls.csv\"/>\n"
                       << "<station name=\"s1\" at=\"1 1 1.5\"/><station name=\"s2\" at=\"13 8 1.2\"/>"
                       << "<station name=\"s3\" at=\"9 1 2\"/><station name=\"rover\" at=\"3 3 0.4\"/>\n"
                       << "<radio.multiwall tx_power=\"1\" l0=\"35\" n=\"2\"/>\n"
                       << "<radio.fading "
                       << (fading.find("shadowing") == fading.npos ? "shadowing=\"4\" decorrelation=\"2\" " : "")
                       << fading << "/>\n"
                       << "<radio.receiver sensitivity=\"-200\"/>" << more << "</world>\n";
  return world;
}

inline constexpr const char* ends = "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]";

// Up and down the flat, 0.6 m between lanes, a reading of each station every 0.35 m.
inline std::vector<std::string> tour() {
  std::vector<std::string> rows;
  double t = 0;
  for (int lane = 0; lane < 21; ++lane) {
    for (double along = 0.4; along < 8.6; along += 0.35, t += 0.7) {
      const double x = 0.7 + 0.6 * lane, y = lane % 2 ? 9 - along : along;
      for (const char* station : {"s1,rover,1,1,1.5", "s2,rover,13,8,1.2", "s3,rover,9,1,2"})
        rows.push_back(print_real(t) + ',' + station + ',' + print_real(x) + ',' + print_real(y) + ",0.4");
    }
  }
  return rows;
}

// The readings of these rows as the world draws them.
inline std::filesystem::path drawn_by(const Scratch& scratch, const std::filesystem::path& world,
                                      const Library::SearchPath& path = plugins,
                                      const std::vector<std::string>& rows = tour()) {
  {
    std::ofstream places(scratch / "places.csv");
    places << ends << '\n';
    for (const std::string& row : rows) places << row << '\n';
  }
  const Eigen::VectorXd drawn = LinkModel(world, scratch / "places.csv", path).drawn();
  std::ofstream measured(scratch / "measured.csv");
  measured << ends << ",rssi[dBm]\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double level = drawn[static_cast<Eigen::Index>(i)];
    measured << rows[i] << ',' << (std::isnan(level) ? "" : print_real(level)) << '\n';
  }
  return scratch / "measured.csv";
}

}  // namespace muster::diagnosis
