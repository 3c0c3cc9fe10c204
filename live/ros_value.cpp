#include "live/ros_value.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include "run_log/tables/cdr.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace muster::live {
namespace {

constexpr int deepest = 32;                     // of nested lists and objects
constexpr std::size_t most_elements = 100'000;  // elements of a sequence

struct Whole {
  int bytes;
  bool is_signed;
};

const std::map<std::string, Whole>& wholes() {
  static const std::map<std::string, Whole> known{
      {"uint8", {1, false}},  {"int8", {1, true}},  {"uint16", {2, false}}, {"int16", {2, true}},
      {"uint32", {4, false}}, {"int32", {4, true}}, {"uint64", {8, false}}, {"int64", {8, true}}};
  return known;
}

[[noreturn]] void wrong(const std::string& at, const Value& given, const std::string& expected) {
  throw Error(Exit::invalid_input, at + ": " + quote(given.dump(-1, ' ', false, Value::error_handler_t::replace)) +
                                       "; expected " + expected);
}

Value whole(const Whole& kind, const Value& given, const std::string& at) {
  const auto refuse = [&] {
    wrong(at, given,
          std::string(kind.is_signed ? "an integer" : "a whole number") + " of " + std::to_string(8 * kind.bytes) +
              " bits");
  };
  if (!given.is_number_integer()) refuse();
  const int bits = 8 * kind.bytes - (kind.is_signed ? 1 : 0);
  const std::uint64_t most = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const bool is_negative = !given.is_number_unsigned() && given.get<std::int64_t>() < 0;
  if (is_negative ? !kind.is_signed || given.get<std::int64_t>() < -static_cast<std::int64_t>(most) - 1
                  : given.get<std::uint64_t>() > most)
    refuse();
  return given;
}

}  // namespace

Value parsed_json(std::string_view text) {
  bool is_deep = false;
  const auto look = [&](int depth, Value::parse_event_t, Value&) {
    is_deep |= depth > deepest;
    return !is_deep;
  };
  Value value = Value::parse(text, look, false);
  return is_deep ? Value(Value::value_t::discarded) : value;
}

RosType::RosType(std::string_view definition) {
  std::istringstream lines{std::string(definition)};
  Fields* fields = &own_;
  for (std::string line; std::getline(lines, line);) {
    if (const auto comment = line.find('#'); comment != line.npos) line.resize(comment);
    if (line.starts_with("====")) continue;
    std::istringstream words(line);
    std::string type, name;
    if (!(words >> type >> name)) continue;
    if (type == "MSG:") {
      fields = &types_[name];
      continue;
    }
    if (line.find('=') != line.npos) continue;  // a constant
    const bool is_sequence = type.ends_with("[]");
    if (is_sequence) type.resize(type.size() - 2);
    fields->push_back({name, type, is_sequence, {}});
    if (std::string initial; words >> initial) fields->back().initial = Value::parse(initial, nullptr, false);
  }
}

const RosType::Fields* RosType::fields_of(const std::string& type) const {
  const auto found = types_.find(type);
  return found == types_.end() ? nullptr : &found->second;
}

Value RosType::completed(const Value& given) const { return completed_fields(own_, given, ""); }

Value RosType::completed_fields(const Fields& fields, const Value& given, const std::string& at) const {
  if (!given.is_object()) wrong(at.empty() ? "the request" : at, given, "an object");
  std::vector<std::string> valid;
  for (const Field& field : fields) valid.push_back(field.name);
  for (const auto& [name, value] : given.items()) {
    if (std::find(valid.begin(), valid.end(), name) == valid.end())
      throw Error(Exit::invalid_input, (at.empty() ? "the request" : at) + " has no field " + quote(name) + "; " +
                                           (valid.empty() ? "expected {}" : suggest(name, valid)));
  }
  Value result = Value::object();
  for (const Field& field : fields) {
    const auto found = given.find(field.name);
    const Value* value = found != given.end() && !found->is_null() ? &*found
                         : field.initial.is_null()                 ? nullptr
                                                                   : &field.initial;
    const std::string place = at.empty() ? field.name : at + '.' + field.name;
    if (!field.is_sequence) {
      result[field.name] = completed_one(field.type, value, place);
      continue;
    }
    result[field.name] = Value::array();
    if (!value) continue;
    if (!value->is_array()) wrong(place, *value, "a list");
    for (const Value& one : *value) result[field.name].push_back(completed_one(field.type, &one, place));
  }
  return result;
}

Value RosType::completed_one(const std::string& type, const Value* given, const std::string& at) const {
  if (const Fields* fields = fields_of(type)) return completed_fields(*fields, given ? *given : Value::object(), at);
  if (type == "string") {
    if (!given) return "";
    if (!given->is_string()) wrong(at, *given, "a text");
    return *given;
  }
  if (type == "bool") {
    if (!given) return false;
    if (!given->is_boolean()) wrong(at, *given, "true or false");
    return *given;
  }
  if (type == "float64") {
    if (!given) return 0.0;
    if (!given->is_number()) wrong(at, *given, "a number");
    return given->get<double>();
  }
  return given ? whole(wholes().at(type), *given, at) : Value(0);
}

std::string RosType::cdr(const Value& complete) const {
  std::string bytes;
  run_log::CdrWriter to(bytes);
  write_fields(own_, complete, to);
  if (own_.empty()) to.put(std::uint8_t{0});  // as ROS 2 has an empty structure
  return bytes;
}

void RosType::write_fields(const Fields& fields, const Value& value, run_log::CdrWriter& to) const {
  for (const Field& field : fields) {
    const Value& one = value.at(field.name);
    if (!field.is_sequence) {
      write_one(field.type, one, to);
      continue;
    }
    to.count(one.size());
    for (const Value& element : one) write_one(field.type, element, to);
  }
}

void RosType::write_one(const std::string& type, const Value& value, run_log::CdrWriter& to) const {
  if (const Fields* fields = fields_of(type)) return write_fields(*fields, value, to);
  if (type == "string") {
    to.text(value.get<std::string>());
  } else if (type == "bool") {
    to.put(static_cast<std::uint8_t>(value.get<bool>()));
  } else if (type == "float64") {
    to.put(value.get<double>());
  } else {
    // Two's complement: the lowest bytes are the number's, whatever its sign.
    const auto bits =
        value.is_number_unsigned() ? value.get<std::uint64_t>() : static_cast<std::uint64_t>(value.get<std::int64_t>());
    switch (wholes().at(type).bytes) {
      case 1:
        to.put(static_cast<std::uint8_t>(bits));
        break;
      case 2:
        to.put(static_cast<std::uint16_t>(bits));
        break;
      case 4:
        to.put(static_cast<std::uint32_t>(bits));
        break;
      default:
        to.put(bits);
    }
  }
}

Value RosType::read_cdr(std::string_view bytes) const {
  run_log::CdrReader from(bytes);
  return read_fields(own_, from);
}

Value RosType::read_fields(const Fields& fields, run_log::CdrReader& from) const {
  Value result = Value::object();
  for (const Field& field : fields) {
    if (!field.is_sequence) {
      result[field.name] = read_one(field.type, from);
      continue;
    }
    result[field.name] = Value::array();
    const std::uint32_t count = from.count();
    if (count > most_elements) throw mcap::Malformed(0, "a sequence of " + std::to_string(count) + " elements");
    for (std::uint32_t i = 0; i < count; ++i) result[field.name].push_back(read_one(field.type, from));
  }
  return result;
}

Value RosType::read_one(const std::string& type, run_log::CdrReader& from) const {
  if (const Fields* fields = fields_of(type)) return read_fields(*fields, from);
  if (type == "string") return std::string(from.text());
  if (type == "float64") return from.real();
  if (type == "bool") return from.whole(1) != 0;
  const Whole kind = wholes().at(type);
  const std::uint64_t bits = from.whole(static_cast<std::size_t>(kind.bytes));
  if (!kind.is_signed) return bits;
  const int unused = 64 - 8 * kind.bytes;
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

}  // namespace muster::live
