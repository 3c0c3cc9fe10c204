#include "diagnosis/report/folder.hpp"

#include <fmt/format.h>

#include <fstream>

#include "diagnosis/report/json.hpp"
#include "diagnosis/report/page.hpp"
#include "text/error.hpp"

namespace muster::report {
namespace {

namespace fs = std::filesystem;

// Planned readings of an advised measurement: radios, places, times and yaws.
std::string advised_csv(const diagnosis::LinkReadings& r, const std::vector<std::string>& radios) {
  const bool timed = !r.t.empty();
  std::string out = timed ? "t[s]," : "";
  out += "tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]";
  if (!r.tx_yaw.empty()) out += ",tx_yaw[rad]";
  if (!r.rx_yaw.empty()) out += ",rx_yaw[rad]";
  out += '\n';
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (timed) out += fmt::format("{:.3f},", r.t[k]);
    out += radios[static_cast<std::size_t>(r.tx[k])] + ',' + radios[static_cast<std::size_t>(r.rx[k])];
    for (const auto& ends : {r.tx_at, r.rx_at}) {
      for (const double v : ends.col(i)) out += fmt::format(",{:.3f}", v);
    }
    for (const auto& yaw : {r.tx_yaw, r.rx_yaw}) {
      if (!yaw.empty()) out += fmt::format(",{:.3f}", yaw[k]);
    }
    out += '\n';
  }
  return out;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw Error(Exit::io, file.string() + ": cannot be written");
}

}  // namespace

std::vector<std::string> write_report(const Diagnosis& diagnosis, const Setting& setting, const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder / "pictures", failed);
  if (failed) throw Error(Exit::io, folder.string() + ": cannot be written: " + failed.message());
  const std::vector<Picture> pictures = pictures_of(diagnosis);
  std::vector<std::string> files;
  const auto add = [&](const fs::path& file, const std::string& text) {
    write(file, text);
    files.push_back(file.string());
  };
  add(folder / "report.html", page_of(diagnosis, setting, pictures));
  add(folder / "diagnosis.json", json_of(diagnosis).dump(2) + "\n");
  if (diagnosis.advised) add(folder / "advised.csv", advised_csv(diagnosis.advised->readings, diagnosis.seen.radios));
  for (const Picture& p : pictures) add(folder / "pictures" / (p.name + ".svg"), plotting::svg(p.figure));
  return files;
}

}  // namespace muster::report
