#include "record_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/text_file.hpp"
#include "text/whole_file.hpp"

namespace muster::viewer {
namespace {

namespace fs = std::filesystem;
using Read = nlohmann::ordered_json;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;

bool is_record(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / run_file, ignored);
}

// Records beside, above and below a folder that is none.
std::vector<std::string> records_near(const fs::path& path) {
  std::vector<std::string> found;
  const fs::path parent =
      path.lexically_normal().has_filename() ? path.parent_path() : path.lexically_normal().parent_path().parent_path();
  for (const fs::path& folder : {path, parent.empty() ? fs::path(".") : parent}) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
      if (is_record(entry.path())) found.push_back(entry.path().lexically_normal().string());
    }
  }
  if (is_record(parent)) found.push_back(parent.lexically_normal().string());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// A world is often given where its record is meant.
[[noreturn]] void fail_no_record(const fs::path& path, const std::string& fault) {
  const std::string expected = "; expected a folder that `muster run WORLD --out DIR` wrote, with its run.json";
  std::error_code ignored;
  const bool is_world = fs::exists(path / "world.xml", ignored) || path.extension() == ".xml";
  const auto near = records_near(path);
  std::string advice;
  if (is_world)
    advice = "; this is a world: run it first";
  else if (!near.empty()) {
    const std::string nearest_one = nearest(path.lexically_normal().string(), near);
    advice = "; did you mean " + quote(nearest_one.empty() ? near.front() : nearest_one) + "?";
  }
  throw invalid({path.string()}, fault + expected + advice);
}

Read parsed(const fs::path& file) {
  const TextFile text = read_text_file(file, most_bytes);
  try {
    return Read::parse(text.text);
  } catch (const Read::parse_error& e) {
    throw invalid(text.place(e.byte ? e.byte - 1 : 0), "is not the JSON of a run; run the world again");
  }
}

RecordedTable table_of(const Read& from) {
  return {from.at("table"), from.at("file"), from.at("kind"), from.at("columns"), from.at("every")};
}

}  // namespace

void write_run_file(const fs::path& folder, const Json& run, const Json& scene,
                    const std::vector<RecordedTable>& tables) {
  Json list = Json::array();
  for (const RecordedTable& one : tables)
    list.push_back(
        {{"table", one.table}, {"file", one.file}, {"kind", one.kind}, {"columns", one.columns}, {"every", one.every}});
  const Json whole{{"format", run_format}, {"run", run}, {"tables", list}, {"scene", scene}};
  write_whole(folder / run_file, whole.dump() + '\n');
}

RecordFolder read_record_folder(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) fail_no_record(path, "there is no such folder");
  if (!fs::is_directory(path, ignored)) fail_no_record(path, "is no folder");
  if (!is_record(path)) fail_no_record(path, "is no record of a run");
  const fs::path file = path / run_file;
  const Read whole = parsed(file);
  try {
    if (const auto format = whole.at("format").get<std::string>(); format != run_format)
      throw invalid({file.string()}, "has the format " + quote(format) + "; expected " + quote(run_format));
    RecordFolder result{.path = path,
                        .world = whole.at("run").at("world"),
                        .dt = whole.at("run").at("dt"),
                        .run = whole.at("run").dump(),
                        .scene = whole.at("scene").dump(),
                        .tables = {}};
    for (const Read& table : whole.at("tables")) result.tables.push_back(table_of(table));
    return result;
  } catch (const Read::exception&) {
    throw invalid({file.string()}, "lacks what a run's record has; run the world again");
  }
}

}  // namespace muster::viewer
