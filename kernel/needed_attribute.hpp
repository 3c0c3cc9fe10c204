// How the help of an attribute ends that counts only beside another:
//   ; only with rssi                       whatever that is, but none, 0 or false
//   ; only with model="multi_wall|disc"    one of these values
//   ; only with duty below 1               a number
//   ; only without socket                  not beside that one
#pragma once

#include <muster/plugin.h>

#include <string>
#include <string_view>
#include <vector>

#include "world_file/world.hpp"

namespace muster {

// Place of a parameter among those of the plugin; -1: it has none of this name.
int find_param(const muster_plugin& plugin, const std::string& name);

// "with model=\"disc\"" of a help that ends in such a clause; "" of any other.
std::string condition_in(std::string_view help);

class Needed {
 public:
  Needed(const std::string& condition, const muster_plugin& plugin);

  // The other attribute.
  const std::string& name() const { return name_; }
  bool holds(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared) const;
  // `without model="disc"`, `beside socket`.
  std::string where_not() const;
  // `model="disc" beside it`.
  std::string wanted() const;

 private:
  std::string name_;
  std::vector<std::string> choices_;  // values of which it has one
  std::string below_;                 // a number that it is below
  bool is_with_ = true;
  bool is_flag_ = false, is_number_ = false;

  std::string value_wanted() const;
};

}  // namespace muster
