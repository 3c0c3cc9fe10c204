#include "tests/real_data/tables.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace muster::real_data {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<Row> rows_of(std::istream& in) {
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  const auto header = cells_of(line);
  while (std::getline(in, line)) {
    const auto cells = cells_of(line);
    Row row;
    for (std::size_t c = 0; c < cells.size() && c < header.size(); ++c) row[header[c]] = cells[c];
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> rows_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return rows_of(in);
}

std::vector<Row> unpacked(const std::filesystem::path& file) {
  FILE* pipe = popen(("gzip -dc '" + file.string() + "'").c_str(), "r");
  std::stringstream text;
  std::array<char, 65536> part{};
  for (std::size_t n; (n = fread(part.data(), 1, part.size(), pipe)) > 0;)
    text.write(part.data(), static_cast<std::streamsize>(n));
  if (pclose(pipe) != 0) throw std::runtime_error("cannot unpack " + file.string());
  return rows_of(text);
}

struct Fingerprint {
  std::string x, y;
  std::map<std::size_t, const Row*> heard;  // by beacon
};

}  // namespace

std::filesystem::path radio_data() { return std::filesystem::path(MUSTER_SOURCE_DIR) / "../shared/data/radio"; }

std::string uji_table(int power_dbm, bool heard_only) {
  const auto folder = radio_data() / "uji_ble_geo";
  const auto beacons = rows_of(folder / "beacons.csv");
  const auto readings = rows_of(folder / "normalised_geo.csv");
  std::map<std::string, Fingerprint> all;
  for (const Row& r : readings) {
    if (std::stoi(r.at("tx_power_dbm")) != power_dbm) continue;
    Fingerprint& f = all[r.at("row")];
    f.x = r.at("rx_x");
    f.y = r.at("rx_y");
    f.heard[std::stoul(r.at("tx"))] = &r;
  }
  std::string out = std::string("tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],") +
                    (heard_only ? "walls_shelf,walls_pillar,rssi[dBm]\n" : "rssi[dBm]\n");
  for (const auto& [name, f] : all) {
    for (std::size_t b = 0; b < beacons.size(); ++b) {
      const auto heard = f.heard.find(b);
      const bool is = heard != f.heard.end();
      if (heard_only && !is) continue;
      out += beacons[b].at("id") + ",phone," + beacons[b].at("x") + ',' + beacons[b].at("y") + ',' + f.x + ',' + f.y;
      if (heard_only) out += ',' + heard->second->at("shelves") + ',' + heard->second->at("pillars");
      out += ',' + (is ? heard->second->at("rssi") : "") + '\n';
    }
  }
  return out;
}

std::string body_table() {
  const std::map<char, std::string> words{{'H', "hand"}, {'P', "pocket"}, {'B', "backpack"}};
  std::ostringstream out;
  out << "tx,rx,distance[m],carried,rssi[dBm]\n";
  for (const std::string way : {"BB", "HB", "HH", "HP", "PB", "PP"}) {
    const auto rows = unpacked(radio_data() / "body_shadow_ble" / ("RSS_human" + way + ".csv.gz"));
    for (std::size_t i = 0; i < rows.size(); i += 10) {
      std::string device = rows[i].at("device");
      for (char& c : device) c = c == ' ' ? '_' : c;
      out << "peer," << device << ',' << std::stod(rows[i].at("dist")) / 100 << ',' << words.at(way[0]) << '_'
          << words.at(way[1]) << ',' << rows[i].at("rss") << '\n';
    }
  }
  return out.str();
}

std::string joined(const std::string& first, const std::string& second) {
  std::string out;
  int sender = 0;
  for (const std::string& table : {first, second}) {
    ++sender;
    std::istringstream in(table);
    std::string line;
    std::getline(in, line);
    if (sender == 1) out += line + '\n';
    while (std::getline(in, line)) out += "tx" + std::to_string(sender) + line.substr(line.find(',')) + '\n';
  }
  return out;
}

}  // namespace muster::real_data
