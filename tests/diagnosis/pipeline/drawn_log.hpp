// Readings that a world draws at given places, read in whole dB, as a measured table.
#pragma once

#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/radio/links/link_model.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {

inline std::filesystem::path table_of(const std::filesystem::path& file, const std::string& columns,
                                      const std::vector<std::string>& rows,
                                      const std::function<std::string(std::size_t)>& last) {
  std::ofstream out(file);
  out << columns << '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) out << rows[i] << last(i) << '\n';
  return file;
}

// `rows`: cells of the columns where the radios are; `listed`: those of the table. `off`: dB, of each reading beside
// what is drawn.
inline std::filesystem::path drawn_log(
    const Scratch& scratch, const std::filesystem::path& world, const std::string& columns,
    const std::vector<std::string>& rows, const std::vector<std::string>& listed,
    const std::function<double(std::size_t)>& off = [](std::size_t) { return 0.0; }) {
  const auto asked = table_of(scratch / "asked.csv", columns, rows, [](std::size_t) { return ""; });
  const Eigen::VectorXd drawn = LinkModel(world, asked, plugins).drawn();
  return table_of(scratch / "measured.csv", columns + ",rssi[dBm]", listed, [&](std::size_t i) {
    return ',' + print_real(std::round(drawn[static_cast<Eigen::Index>(i)] + off(i)));
  });
}

}  // namespace muster::diagnosis
