// A value to print as JSON. Members keep their order; what is not finite is null, for JSON has no NaN.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace muster {

class Json {
 public:
  using Array = std::vector<Json>;
  using Members = std::vector<std::pair<std::string, Json>>;

  Json(std::nullptr_t = nullptr) {}
  Json(std::integral auto value) {
    using Given = decltype(value);
    if constexpr (std::same_as<Given, bool>)
      value_ = value;
    else
      value_ = static_cast<std::conditional_t<std::signed_integral<Given>, std::int64_t, std::uint64_t>>(value);
  }
  Json(double value);
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <class T>
  Json(const std::vector<T>& list) : value_(Array(list.begin(), list.end())) {}
  Json(const std::set<std::string>& list) : value_(Array(list.begin(), list.end())) {}
  template <class T>
  Json(const std::map<std::string, T>& members) : value_(Members(members.begin(), members.end())) {}
  // {{"name", value}, ...} is an object, any other list an array.
  Json(std::initializer_list<Json> list);

  static Json array();
  static Json object();

  // A member, made where there is none. What is null becomes an object.
  Json& operator[](const std::string& name);
  // Appends. What is null becomes an array.
  void push_back(Json value);
  // Takes the members of another object over.
  void update(const Json& other);

  bool is_null() const { return std::holds_alternative<std::nullptr_t>(value_); }
  bool contains(const std::string& name) const { return find(name) != nullptr; }
  // The member, element, number or text that is known to be there; else throws std::logic_error.
  const Json& operator[](const std::string& name) const;
  const Array& elements() const;
  const Members& members() const;
  double real() const;
  const std::string& text() const;

  // On one line, or with so many spaces at each level. Bytes that are no UTF-8 become U+FFFD.
  std::string dump(int indent = -1) const;

 private:
  friend struct JsonPrinter;
  const Json* find(const std::string& name) const;

  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Members> value_;
};

}  // namespace muster
