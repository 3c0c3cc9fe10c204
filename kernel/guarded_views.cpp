#include "guarded_views.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace muster {
namespace {

constexpr std::size_t guards = 16;  // cells on either side
const double guard = std::bit_cast<double>(uint64_t{0x7ffc5afe5afe5afe});
const double closed = std::bit_cast<double>(uint64_t{0x7ffc0ff10ff10ff1});

bool all_are(const double* cells, std::size_t count, double value) {
  return std::all_of(cells, cells + count, [&](const double& cell) {
    return std::bit_cast<uint64_t>(cell) == std::bit_cast<uint64_t>(value);
  });
}

}  // namespace

GuardedViews::Copy GuardedViews::copy_of(const double* from, double* to, std::size_t count) {
  Copy copy{{}, from, to, count};
  if (!from) return copy;
  copy.cells.assign(count + 2 * guards, guard);
  std::copy_n(from, count, copy.cells.begin() + guards);
  return copy;
}

std::size_t GuardedViews::cells_of(const std::vector<muster_in>& in, const std::vector<muster_out>& out) {
  std::size_t result = 0;
  for (const muster_in& view : in) result += std::size_t{view.rows} * view.cols;
  for (const muster_out& view : out) result += std::size_t{view.rows} * view.cols;
  return result;
}

void GuardedViews::open(std::vector<muster_in>& in, std::vector<muster_out>& out) {
  in_ = &in;
  out_ = &out;
  read_.clear();
  written_.clear();
  for (muster_in& view : in) {
    read_.push_back(copy_of(view.data, nullptr, std::size_t{view.rows} * view.cols));
    if (view.data) view.data = read_.back().cells.data() + guards;
  }
  for (muster_out& view : out) {
    written_.push_back(copy_of(view.data, view.data, std::size_t{view.rows} * view.cols));
    if (view.data) view.data = written_.back().cells.data() + guards;
  }
}

GuardedViews::Fault GuardedViews::close() {
  Fault fault;
  const auto add = [&](std::size_t claim, const char* words) {
    if (fault.words.empty()) fault = {claim, words};
  };
  for (std::size_t i = 0; i < read_.size(); ++i) {
    for (Copy* copy : {&read_[i], &written_[i]}) {
      if (copy->cells.empty()) continue;
      const double* begin = copy->cells.data();
      if (!all_are(begin, guards, guard)) add(i, "writes before the first cell of");
      if (!all_are(begin + guards + copy->count, guards, guard)) add(i, "writes behind the last cell of");
      if (copy->to)
        std::copy_n(begin + guards, copy->count, copy->to);
      else if (std::memcmp(begin + guards, copy->from, copy->count * sizeof(double)) != 0)
        add(i, "changes what it was given to read of");
      std::fill(copy->cells.begin(), copy->cells.end(), closed);
    }
    (*in_)[i].data = read_[i].from;
    (*out_)[i].data = written_[i].to;
    kept_.emplace_back(std::move(read_[i]), std::move(written_[i]));
  }
  in_ = nullptr;
  out_ = nullptr;
  return fault;
}

GuardedViews::Fault GuardedViews::written_since() {
  Fault fault;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    for (const Copy* copy : {&kept_[i].first, &kept_[i].second})
      if (fault.words.empty() && !all_are(copy->cells.data(), copy->cells.size(), closed))
        fault = {i, "keeps a pointer beyond its step, and wrote through it into"};
  }
  kept_.clear();
  return fault;
}

}  // namespace muster
