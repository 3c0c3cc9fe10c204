// Writes the measured data of worlds/hall: 20,000 readings of a robot that roams over a floor with rooms while a fixed
// radio at (0, 0) sends. A program of its own: its geometry and formulas share nothing with those of the plugins, so an
// error of theirs cannot hide in the data.
//
//   hall_data walls.csv measured_plain.csv plain     the model of world.xml, and Rayleigh fading
//   hall_data walls.csv measured.csv hidden          and something that the map does not show (hidden.hpp)
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "hidden.hpp"
#include "tour.hpp"

namespace {

constexpr int samples = 20000;
constexpr double period = 0.2;                           // s
constexpr double base_height = 1.0, rover_height = 0.4;  // m
constexpr std::uint64_t seed = 42;

struct Segment {
  Place a, b;
};

// Columns name,x0[m],y0[m],x1[m],y1[m],... of the world's map; all walls are taller than both radios.
std::vector<Segment> read_walls(const std::string& file) {
  std::ifstream in(file);
  in.imbue(std::locale::classic());
  std::string line;
  if (!std::getline(in, line) || line.rfind("name,x0[m],y0[m],x1[m],y1[m],", 0) != 0)
    throw std::runtime_error(file + " is not a table of walls");
  std::vector<Segment> walls;
  while (std::getline(in, line)) {
    Segment wall;
    if (std::sscanf(line.c_str(), "%*[^,],%lf,%lf,%lf,%lf", &wall.a.x, &wall.a.y, &wall.b.x, &wall.b.y) != 4)
      throw std::runtime_error(file + ": this is no wall: " + line);
    walls.push_back(wall);
  }
  return walls;
}

// Whether p -> q meets the wall: solves p + s (q - p) = a + u (b - a).
bool meets(const Segment& wall, Place p, Place q) {
  const double dx = q.x - p.x, dy = q.y - p.y, ex = wall.b.x - wall.a.x, ey = wall.b.y - wall.a.y;
  const double det = dx * ey - dy * ex;
  if (det == 0) return false;
  const double fx = wall.a.x - p.x, fy = wall.a.y - p.y;
  const double s = (fx * ey - fy * ex) / det, u = (fx * dy - fy * dx) / det;
  return s > 0 && s < 1 && u > 0 && u < 1;
}

// Received power in dBm before fading: the paper's -12.9 - 17 log10 d - 4 k.
double mean_power(const std::vector<Segment>& walls, Place base, Place rover) {
  const double x = rover.x - base.x, y = rover.y - base.y, z = rover_height - base_height;
  int crossed = 0;
  for (const Segment& wall : walls) crossed += meets(wall, base, rover);
  return -12.9 - 8.5 * std::log10(x * x + y * y + z * z) - 4.0 * crossed;
}

void write(const std::string& file, const std::vector<Segment>& walls, bool hidden) {
  std::mt19937_64 random(seed);  // its numbers are fixed by the C++ standard
  const std::vector<Step> tour = tour_of_rooms(samples);
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (!out) throw std::runtime_error(file + " cannot be written");
  std::fputs("t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],rssi[dBm]\n", out);
  const Place base{0, 0};
  for (int i = 0; i < samples; ++i) {
    // To the millimetre, as written: what a reader computes from the file is what was measured.
    const Place rover{std::round(tour[i].at.x * 1000) / 1000, std::round(tour[i].at.y * 1000) / 1000};
    const double uniform = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
    const double power = -std::log(uniform);  // linear power of Rayleigh fading: exponential, mean 1
    double rssi = mean_power(walls, base, rover) + 10 * std::log10(power);
    if (hidden) rssi -= hidden_loss(base, rover);
    std::fprintf(out, "%.1f,base,rover,0,0,%.1f,%.3f,%.3f,%.1f,%.3f,%.2f\n", period * i, base_height, rover.x, rover.y,
                 rover_height, tour[i].heading, rssi);
  }
  if (std::fclose(out) != 0) throw std::runtime_error(file + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc == 4 ? argv[3] : "";
  if (what != "plain" && what != "hidden") {
    std::cerr << "usage: hall_data WALLS OUT plain|hidden\n";
    return 2;
  }
  try {
    write(argv[2], read_walls(argv[1]), what == "hidden");
  } catch (const std::exception& e) {
    std::cerr << "hall_data: " << e.what() << '\n';
    return 1;
  }
}
