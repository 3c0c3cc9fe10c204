// Tables of thresholds: in the headers that hold them, and on the page that shows them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace muster::test {

struct Threshold {
  std::string name{}, value{}, unit{}, meaning{}, origin{}, test{};

  bool operator==(const Threshold&) const = default;
};

std::string in_words(const Threshold& threshold);

// The headers diagnosis/*/thresholds.hpp, by path.
std::vector<std::filesystem::path> threshold_headers(const std::filesystem::path& root);

// Constants of a header, each with the four columns of the comment above it. Columns that are missing are empty.
std::vector<Threshold> thresholds_in_header(std::string_view text);

// Rows of the page's tables.
std::vector<Threshold> thresholds_on_page(std::string_view text);

// Suite.Name of each test in the sources below tests/.
std::vector<std::string> test_names(const std::filesystem::path& root);

}  // namespace muster::test
