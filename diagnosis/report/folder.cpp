#include "diagnosis/report/folder.hpp"

#include <fstream>

#include "diagnosis/report/json.hpp"
#include "diagnosis/report/page.hpp"
#include "text/error.hpp"

namespace muster::report {
namespace {

namespace fs = std::filesystem;

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
  for (const Picture& p : pictures) add(folder / "pictures" / (p.name + ".svg"), picture::svg(p.figure));
  return files;
}

}  // namespace muster::report
