#include "record.hpp"

#include <algorithm>
#include <fstream>
#include <set>

#include "text/names.hpp"

namespace muster {
namespace {

// "robot/*/pose" becomes robot_pose.csv, and a single row's "robot/leader/pose" robot_leader_pose.csv.
std::string file_name(const std::string& table) {
  std::string result;
  for (const char c : table) {
    if (c == '*') continue;
    const bool break_here = c == '/' || c == '@';
    if (!break_here)
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  return result + ".csv";
}

// A file of that name that no run has recorded, by its first line: the user's own.
void refuse_to_replace(const std::filesystem::path& path, const std::vector<TextColumn>& columns) {
  std::ifstream there(path);
  std::string first, expected;
  if (!std::getline(there, first)) return;
  for (const TextColumn& column : columns) expected += (expected.empty() ? "" : ",") + column.label();
  if (first != expected)
    throw Error(Exit::invalid_input, Place{path.string()},
                "is there already and was not recorded by a run of these tables; expected another folder, or that file "
                "taken away");
}

// A table's own column with the name of an earlier column gets the set's name as a prefix, "scan_t": names must be
// unique.
std::vector<TextColumn> header(const Table& table) {
  const std::string& whole = table.set().name;
  const std::string set = whole.substr(0, whole.find('/'));
  std::vector<TextColumn> result = {{"t", "s"}, {set, ""}};
  for (const auto& column : table.columns()) {
    const bool is_taken = column.name == "t" || column.name == set;
    result.push_back({is_taken ? set + '_' + column.name : column.name, column.unit});
  }
  return result;
}

// Bytes as hexadecimal digits; of more than a row may hold, such as a picture, only their number.
std::string digits(const std::vector<uint8_t>& bytes) {
  constexpr std::size_t most = 16384;
  if (bytes.size() > most) return std::to_string(bytes.size()) + " bytes";
  static constexpr char digit[] = "0123456789abcdef";
  std::string result;
  for (const uint8_t byte : bytes) {
    result += digit[byte >> 4];
    result += digit[byte & 15];
  }
  return result;
}

void write_cell(TextTableWriter& writer, const Simulation& run, const Cells& cells, const Column& column,
                double value) {
  const Set* set = column.reference.empty() ? nullptr : run.board().find_set(column.reference);
  if (column.bytes)
    writer.text(value == 0 ? "" : digits(*cells.blobs[static_cast<std::size_t>(value) - 1]));
  else if (set && set->is_named())
    writer.text(cell_text(run.board(), column, value));
  else
    writer.real(value);
}

TableView recorded(const Simulation& run, const RecordDeclaration& declared) {
  try {
    return run.table(declared.table);
  } catch (const Error& e) {
    if (e.exit() != Exit::invalid_input || declared.place.file.empty()) throw;
    throw invalid(declared.place, (declared.place.line > 0 ? "record: " : "") + std::string(e.what()));
  }
}

}  // namespace

void check_records(const Simulation& run) {
  for (const auto& declared : run.world().records) recorded(run, declared);
}

Recorder::Recorder(const Simulation& run, const std::vector<RecordDeclaration>& tables,
                   const std::filesystem::path& folder) {
  std::error_code made;
  std::filesystem::create_directories(folder, made);
  if (made) throw Error(Exit::io, Place{folder.string()}, "cannot be made: " + made.message());
  std::set<std::string> seen;
  for (const auto& declared : tables) {
    if (!seen.insert(declared.table).second) continue;
    const auto path = folder / file_name(declared.table);
    const auto columns = header(*recorded(run, declared).table);
    refuse_to_replace(path, columns);
    auto writer = std::make_unique<TextTableWriter>(path, columns, Unfinished::kept);
    files_.push_back({{declared.table, declared.every, path}, std::move(writer)});
  }
}

std::vector<Recorder::File> Recorder::files() const {
  std::vector<File> result;
  for (const auto& open : files_) result.push_back(open.file);
  return result;
}

void Recorder::write(const Simulation& run) {
  for (auto& [file, writer] : files_) {
    const auto found = run.find_table(file.table);
    if (!found) continue;  // it went with a plugin
    const TableView view = *found;
    const Table& table = *view.table;
    const Set& set = table.set();
    if (set.kind != SetKind::queue && run.tick() % file.every != 0)
      continue;  // a message appears once: none is left out
    const Cells& cells = table.now();
    const std::size_t first = view.row >= 0 ? static_cast<std::size_t>(view.row) : 0;
    const std::size_t last = view.row >= 0 ? first + 1 : cells.rows;
    for (std::size_t r = first; r < last; ++r) {
      if (set.is_named() && !set.alive[r]) continue;
      if (set.kind == SetKind::queue && cells.appended[r] != run.tick()) continue;  // each message once
      writer->real(run.time());
      if (set.is_named())
        writer->text(set.names[r]);
      else
        writer->real(static_cast<double>(r));
      for (std::size_t c = 0; c < table.width(); ++c)
        write_cell(*writer, run, cells, table.columns()[c], cells.data[r * table.width() + c]);
      writer->end_row();
    }
  }
}

void Recorder::flush() {
  for (auto& [file, writer] : files_) writer->flush();
}

std::vector<std::filesystem::path> Recorder::close() {
  std::vector<std::filesystem::path> result;
  for (auto& [file, writer] : files_) {
    writer->close();
    result.push_back(file.path);
  }
  files_.clear();
  return result;
}

}  // namespace muster
