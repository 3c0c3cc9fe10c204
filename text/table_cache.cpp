#include "table_cache.hpp"

namespace muster {

std::shared_ptr<const TextTable> TableCache::read(const std::filesystem::path& file) {
  std::error_code none;  // a file that is not there is refused by TextTable, in its own words
  const auto written = std::filesystem::last_write_time(file, none);
  const auto size = std::filesystem::file_size(file, none);
  const std::lock_guard lock(mutex_);
  Known& known = known_[std::filesystem::absolute(file).lexically_normal()];
  if (known.tables.empty() || known.written != written || known.size != size)
    known = {written, size, {std::make_shared<const TextTable>(TextTable::read(file))}};
  // Messages name a file as it was asked for.
  for (const auto& table : known.tables) {
    if (table->file() == file.string()) return table;
  }
  known.tables.push_back(std::make_shared<const TextTable>(known.tables[0]->named(file.string())));
  return known.tables.back();
}

void TableCache::put(const std::filesystem::path& file, std::shared_ptr<const TextTable> table) {
  std::error_code none;
  const auto written = std::filesystem::last_write_time(file, none);
  const auto size = std::filesystem::file_size(file, none);
  const std::lock_guard lock(mutex_);
  known_[std::filesystem::absolute(file).lexically_normal()] = {written, size, {std::move(table)}};
}

}  // namespace muster
