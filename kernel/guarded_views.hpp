// Views of a step that lie in memory of their own, between guard cells, so that what a plugin writes beside its cells
// is seen. It takes copies of all that the step reads and writes: for single steps.
#pragma once

#include <muster/plugin.h>

#include <string>
#include <utility>
#include <vector>

namespace muster {

class GuardedViews {
 public:
  // How many cells it would copy.
  static std::size_t cells_of(const std::vector<muster_in>& in, const std::vector<muster_out>& out);
  // From now on the views are of copies.
  void open(std::vector<muster_in>& in, std::vector<muster_out>& out);

  struct Fault {
    std::size_t claim = 0;
    std::string words;  // "writes a cell after the last one of its rows of"; empty: none
  };
  // After the step: takes over the cells that were to be written, and the views are as before. The copies are kept.
  Fault close();
  bool is_open() const { return in_ != nullptr; }

  // What was written into the copies that are kept, since their step; they go. Call it after the step that follows.
  Fault written_since();
  bool keeps_any() const { return !kept_.empty(); }

 private:
  struct Copy {
    std::vector<double> cells;  // guards, the view's cells, guards
    const double* from = nullptr;
    double* to = nullptr;  // null: only read
    std::size_t count = 0;
  };
  static Copy copy_of(const double* from, double* to, std::size_t count);

  std::vector<muster_in>* in_ = nullptr;
  std::vector<muster_out>* out_ = nullptr;
  std::vector<Copy> read_, written_;  // of each claim
  std::vector<std::pair<Copy, Copy>> kept_;
};

}  // namespace muster
