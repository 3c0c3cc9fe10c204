// Values of ROS 2's messages between JSON and CDR, as a definition in ros2msg has them.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace muster::run_log {
class CdrReader;
class CdrWriter;
}  // namespace muster::run_log

namespace muster::live {

using Value = nlohmann::ordered_json;

// Discarded where the text is no JSON, or is nested more deeply than anybody means: printing it again would need a
// stack as deep.
Value parsed_json(std::string_view text);

class RosType {
 public:
  // Fields of builtin types, of strings, of sequences of them, and of types that follow after a line of "=".
  explicit RosType(std::string_view definition);

  // The value with every field of the type, those that are not given zero or empty. Throws Error that names the field
  // which is unknown, or of another kind.
  Value completed(const Value& given) const;
  std::string cdr(const Value& complete) const;
  // Throws mcap::Malformed where the bytes end before the value does.
  Value read_cdr(std::string_view bytes) const;

 private:
  struct Field {
    std::string name, type;
    bool is_sequence = false;
    Value initial{};  // null: zero or empty
  };
  using Fields = std::vector<Field>;

  const Fields* fields_of(const std::string& type) const;
  Value completed_fields(const Fields& fields, const Value& given, const std::string& at) const;
  Value completed_one(const std::string& type, const Value* given, const std::string& at) const;
  void write_fields(const Fields& fields, const Value& value, run_log::CdrWriter& to) const;
  void write_one(const std::string& type, const Value& value, run_log::CdrWriter& to) const;
  Value read_fields(const Fields& fields, run_log::CdrReader& from) const;
  Value read_one(const std::string& type, run_log::CdrReader& from) const;

  Fields own_;
  std::map<std::string, Fields> types_;
};

}  // namespace muster::live
