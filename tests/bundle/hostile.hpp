// Archives that no `muster bundle` writes.
#pragma once

#include <archive.h>
#include <archive_entry.h>

#include <filesystem>
#include <string>
#include <vector>

namespace muster::test {

struct HostileEntry {
  std::string name, bytes;
  int type = AE_IFREG;
  std::string link{};      // what it is a symbolic link to
  std::string hardlink{};  // what it is another name of
};

inline void write_archive(const std::filesystem::path& file, const std::vector<HostileEntry>& entries,
                          bool compressed = true) {
  ::archive* to = ::archive_write_new();
  if (compressed) ::archive_write_add_filter_zstd(to);
  ::archive_write_set_format_gnutar(to);
  ::archive_write_open_filename(to, file.c_str());
  for (const HostileEntry& one : entries) {
    ::archive_entry* entry = ::archive_entry_new();
    ::archive_entry_set_pathname(entry, one.name.c_str());
    ::archive_entry_set_filetype(entry, static_cast<unsigned>(one.type));
    ::archive_entry_set_perm(entry, 0755);
    ::archive_entry_set_size(entry, static_cast<std::int64_t>(one.bytes.size()));
    if (!one.link.empty()) ::archive_entry_set_symlink(entry, one.link.c_str());
    if (!one.hardlink.empty()) ::archive_entry_set_hardlink(entry, one.hardlink.c_str());
    ::archive_write_header(to, entry);
    ::archive_write_data(to, one.bytes.data(), one.bytes.size());
    ::archive_entry_free(entry);
  }
  ::archive_write_close(to);
  ::archive_write_free(to);
}

}  // namespace muster::test
