#include "text/json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace muster {
namespace {

template <class T, class Value>
const T& stored(const Value& value, const char* what) {
  const T* result = std::get_if<T>(&value);
  if (!result) throw std::logic_error(std::string("JSON: this is no ") + what);
  return *result;
}

}  // namespace

Json::Json(double value) {
  if (std::isfinite(value)) value_ = value;
}

Json::Json(std::initializer_list<Json> list) {
  const bool is_object = std::all_of(list.begin(), list.end(), [](const Json& one) {
    const Array* pair = std::get_if<Array>(&one.value_);
    return pair && pair->size() == 2 && std::holds_alternative<std::string>(pair->front().value_);
  });
  if (!is_object) {
    value_ = Array(list);
    return;
  }
  value_ = Members();
  for (const Json& pair : list) (*this)[pair.elements()[0].text()] = pair.elements()[1];
}

Json Json::array() {
  Json result;
  result.value_ = Array();
  return result;
}

Json Json::object() {
  Json result;
  result.value_ = Members();
  return result;
}

const Json* Json::find(const std::string& name) const {
  const Members* members = std::get_if<Members>(&value_);
  if (!members) return nullptr;
  const auto at =
      std::find_if(members->begin(), members->end(), [&](const auto& member) { return member.first == name; });
  return at == members->end() ? nullptr : &at->second;
}

Json& Json::operator[](const std::string& name) {
  if (is_null()) value_ = Members();
  if (const Json* there = find(name)) return const_cast<Json&>(*there);
  stored<Members>(value_, "object");
  return std::get<Members>(value_).emplace_back(name, Json()).second;
}

void Json::push_back(Json value) {
  if (is_null()) value_ = Array();
  stored<Array>(value_, "array");
  std::get<Array>(value_).push_back(std::move(value));
}

void Json::update(const Json& other) {
  for (const auto& [name, value] : other.members()) (*this)[name] = value;
}

const Json& Json::operator[](const std::string& name) const {
  const Json* result = find(name);
  if (!result) throw std::logic_error("JSON: there is no member " + name);
  return *result;
}

const Json::Array& Json::elements() const { return stored<Array>(value_, "array"); }
const Json::Members& Json::members() const { return stored<Members>(value_, "object"); }
const std::string& Json::text() const { return stored<std::string>(value_, "text"); }
double Json::real() const { return stored<double>(value_, "number"); }

// The printing of nlohmann-json: the shortest digits that give a number back, escapes; bytes that are no UTF-8 become
// U+FFFD.
struct JsonPrinter {
  using Printed = nlohmann::ordered_json;

  Printed operator()(const Json::Array& array) const {
    Printed result = Printed::array();
    for (const Json& one : array) result.push_back(std::visit(*this, one.value_));
    return result;
  }
  Printed operator()(const Json::Members& members) const {
    Printed result = Printed::object();
    for (const auto& [name, value] : members) result.emplace(name, std::visit(*this, value.value_));
    return result;
  }
  Printed operator()(const auto& value) const { return value; }
};

std::string Json::dump(int indent) const {
  return std::visit(JsonPrinter(), value_).dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace muster
