// Reads an MCAP file from its first byte to its last, whatever is in it: each record is checked before it is handed on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "records.hpp"

namespace muster::mcap {

// What a scan hands on, in the file's order. A message's channel was handed on before.
struct Visitor {
  virtual ~Visitor() = default;
  virtual void header(const Header&) {}
  virtual void schema(const Schema&) {}
  virtual void channel(const Channel&) {}
  virtual void message(const Message&, const std::string& /*where, for errors*/) {}
  virtual void metadata(const Metadata&) {}
};

struct Scan {
  std::string profile, library;
  std::uint64_t bytes = 0;                 // of the file
  std::uint64_t chunks = 0;                // that were handed on
  std::uint64_t packed = 0, unpacked = 0;  // bytes of them, compressed and not
  std::uint64_t attachments = 0;           // that were not handed on
  bool is_whole = false;                   // it ends as a complete file does
  std::vector<std::string> damages;        // "byte 1234: ..."
};

enum class Damage {
  refused,  // the first one is an Error
  skipped   // a damaged chunk is left out, and what follows a record that cannot be told is not read
};

// Throws Error where the file cannot be read or is no MCAP file; what the visitor throws passes.
Scan scan(const std::filesystem::path& path, Visitor& visitor, Damage damage);

}  // namespace muster::mcap
