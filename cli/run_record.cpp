#include "run_record.hpp"

#include "installation.hpp"
#include "verbs.hpp"
#include "viewer/page.hpp"
#include "viewer/record_folder.hpp"

namespace muster::cli {
namespace {

constexpr std::uintmax_t most_bytes = 100'000'000;  // of tables that every run makes a page of: some seconds

const char* word_of(SetKind kind) {
  switch (kind) {
    case SetKind::fixed:
      return "fixed";
    case SetKind::live:
      return "live";
    case SetKind::queue:
      return "queue";
    case SetKind::listed:
      break;
  }
  return "listed";
}

}  // namespace

RunRecord::RunRecord(const Simulation& run, const std::vector<RecordDeclaration>& tables,
                     const std::filesystem::path& folder, const Library::SearchPath& plugins)
    : start_(run.time()),
      folder_(folder),
      lock_(folder, "--out"),
      recorder_(run, tables, folder),
      scene_(run, plugins),
      listed_(listed(run)) {
  for (const char* of_an_earlier_run : {viewer::run_file, "run.html"}) {
    std::error_code ignored;
    std::filesystem::remove(folder / of_an_earlier_run, ignored);
  }
}

void RunRecord::write(const Simulation& run) {
  recorder_.write(run);
  const auto now = std::chrono::steady_clock::now();
  if (now - flushed_ < std::chrono::seconds(1)) return;
  recorder_.flush();
  flushed_ = now;
}

std::vector<viewer::RecordedTable> RunRecord::listed(const Simulation& run) const {
  std::vector<viewer::RecordedTable> result;
  for (const auto& file : recorder_.files()) {
    const Table& table = *run.table(file.table).table;
    result.push_back(
        {file.table, file.path.filename().string(), word_of(table.set().kind), table.columns().text(), file.every});
  }
  return result;
}

void RunRecord::complete(const Simulation& run, Json& outcome) {
  outcome["start"] = start_;
  outcome["file"] = run.world().file.string();
  outcome["version"] = MUSTER_VERSION;
  outcome["chains"] = viewer::chains_of(run);
}

viewer::RecordFolder RunRecord::so_far(const Simulation& run, Json outcome) {
  complete(run, outcome);
  const Json scene = scene_.json(run);
  outcome["notes"] = scene_.notes();
  recorder_.flush();
  auto tables = closed_.empty() ? listed_ : closed_;
  if (closed_.empty()) {
    for (auto& table : tables) table.file += ".part";
  }
  return {folder_, run.world().name, run.world().dt, outcome.dump(), scene.dump(), std::move(tables)};
}

std::vector<std::filesystem::path> RunRecord::close(const Simulation& run, Json outcome) {
  closed_ = listed_;
  tables_ = recorder_.close();
  complete(run, outcome);
  const Json scene = scene_.json(run);
  outcome["notes"] = scene_.notes();
  viewer::write_run_file(folder_, outcome, scene, closed_);
  auto files = tables_;
  files.push_back(folder_ / viewer::run_file);
  return files;
}

std::filesystem::path RunRecord::write_page(std::string& why_not) const {
  if (tables_.empty()) return {};
  std::uintmax_t bytes = 0;
  for (const auto& table : tables_) bytes += std::filesystem::file_size(table);
  why_not = viewer::why_no_page(installation().parts);
  if (bytes > most_bytes)
    why_not = "the tables have " + std::to_string(bytes / 1'000'000) + " MB; `muster report " + folder_.string() +
              "` makes a page of them";
  if (!why_not.empty()) return {};
  auto page = folder_ / "run.html";
  viewer::write_page(folder_, page, installation().parts);
  return page;
}

}  // namespace muster::cli
