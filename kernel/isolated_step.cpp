#include "isolated_step.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

#include "shared_values.hpp"

namespace muster {
namespace {

constexpr std::size_t least_bytes = std::size_t{1} << 20, most_bytes = std::size_t{1} << 32;

bool any_bytes(const Columns& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].bytes) return true;
  }
  return false;
}

bool appends(const Claim& claim) { return claim.out && (claim.lists || claim.out->set().kind == SetKind::queue); }

std::size_t table_bytes(const std::vector<Claim>& claims) {
  std::size_t cells = 0;
  for (const Claim& claim : claims) {
    for (const Table* table : {claim.in, claim.out}) cells += table ? table->now().data.size() : 0;
    if (claim.file) cells += claim.file->data.size();
  }
  return cells * sizeof(double);
}

}  // namespace

// What goes to the other process and what comes back, in the order in which it stands in memory: the input, with the
// cells that are to be filled, in the first half, and all else that a step does in the second.
class IsolatedStep::Crossing {
 public:
  Crossing(Instance& instance, Surroundings& around, std::byte* memory, std::size_t bytes)
      : instance_(instance), around_(around), begin_(memory), half_(begin_ + bytes / 2), end_(begin_ + bytes) {}

  // Here. False where it does not fit.
  bool send(const muster_tick& now) try {
    ValueWriter to(begin_, half_);
    to.put(now.index);
    to.put(now.flags);
    to.put(&now.time, 1);
    to.put(instance_.params_.data(), instance_.params_.size());
    for (const auto& [name, set] : around_.board->sets())
      if (set->kind == SetKind::listed) to.put(set->listed);
    filled_.clear();
    for (std::size_t i = 0; i < instance_.claims_.size(); ++i) {
      const Claim& claim = instance_.claims_[i];
      const muster_in& in = instance_.in_[i];
      to.put(in.rows);
      to.put(in.cols);
      to.put(in.tick);
      to.put(in.data, std::size_t{in.rows} * in.cols);
      if (claim.in && any_bytes(claim.columns)) {
        to.put(claim.in->now().blobs.size());
        for (const Blob& blob : claim.in->now().blobs) to.put(blob);
      }
      const muster_out out = claim.out ? instance_.out_[i] : muster_out{};
      to.put(out.rows);
      to.put(out.cols);
      filled_.push_back(to.put(out.data, std::size_t{out.rows} * out.cols));
    }
    return true;
  } catch (const DoesNotFit&) {
    return false;
  }

  // There. The views point into the memory.
  muster_tick receive() {
    ValueReader from(begin_, half_);
    muster_tick now{};
    now.index = from.number();
    now.flags = static_cast<uint32_t>(from.number());
    now.time = *from.numbers(1);
    const double* params = from.numbers(instance_.params_.size());
    instance_.params_.assign(params, params + instance_.params_.size());
    for (const auto& [name, set] : around_.board->sets())
      if (set->kind == SetKind::listed) set->listed = from.number();
    for (std::size_t i = 0; i < instance_.claims_.size(); ++i) {
      Claim& claim = instance_.claims_[i];
      muster_in& in = instance_.in_[i];
      in.rows = static_cast<uint32_t>(from.number());
      in.cols = static_cast<uint32_t>(from.number());
      in.tick = from.number();
      in.data = from.numbers(in.rows, in.cols);
      if (claim.in && any_bytes(claim.columns)) {
        auto& blobs = claim.in->stored().blobs;
        blobs.resize(from.number());
        for (Blob& blob : blobs) blob = from.blob();
      }
      muster_out& out = instance_.out_[i];
      out.rows = static_cast<uint32_t>(from.number());
      out.cols = static_cast<uint32_t>(from.number());
      out.data = from.numbers(out.rows, out.cols);
      claim.appended = 0;
      claim.puts.clear();
      if (appends(claim)) claim.aside.clear();
    }
    forget();
    return now;
  }

  // There. The first number is 0 until all is written.
  void answer(bool fine) try {
    ValueWriter to(half_, end_);
    to.put(uint64_t{0});
    to.put(static_cast<uint64_t>(fine));
    to.put(instance_.error_);
    to.put(static_cast<uint64_t>(instance_.fault_));
    to.put(static_cast<uint64_t>(instance_.refused_));
    to.put(instance_.events.size());
    for (const std::string& event : instance_.events) to.put(event);
    for (const Claim& claim : instance_.claims_) {
      to.put(claim.appended);
      if (appends(claim)) to.put(claim.aside.data(), claim.appended * claim.columns.size());
      to.put(claim.puts.size());
      for (const auto& put : claim.puts) {
        to.put(put.row);
        to.put(put.column);
        to.put(put.blob);
      }
    }
    to.put(instance_.joins.size());
    for (const Join& join : instance_.joins) {
      to.put(join.set->name);
      to.put(join.name);
      to.put(static_cast<uint64_t>(int64_t{join.like}));
      to.put(join.values.size());
      for (const auto& value : join.values) {
        to.put(value.quantity);
        to.put(value.column);
        to.put(&value.value, 1);
      }
    }
    to.put(instance_.leaves.size());
    for (const Leave& leave : instance_.leaves) {
      to.put(leave.set->name);
      to.put(leave.row);
    }
    const uint64_t whole = 1;
    std::memcpy(half_, &whole, sizeof whole);
  } catch (const DoesNotFit&) {
  }

  // Here. Nothing where the answer did not fit.
  std::optional<bool> take() {
    ValueReader from(half_, end_);
    if (from.number() == 0) return {};
    const bool fine = from.number() != 0;
    instance_.error_ = from.text();
    instance_.fault_ =
        from.number() == static_cast<uint64_t>(Exit::invalid_input) ? Exit::invalid_input : Exit::plugin_fault;
    instance_.refused_ = from.number() != 0;
    for (uint64_t n = from.number(); n > 0; --n) instance_.events.push_back(from.text());
    for (std::size_t i = 0; i < instance_.claims_.size(); ++i) {
      Claim& claim = instance_.claims_[i];
      if (const muster_out& out = instance_.out_[i]; claim.out && out.data)
        std::copy_n(filled_[i], std::size_t{out.rows} * out.cols, out.data);
      claim.appended = from.number();
      if (appends(claim)) {
        const double* rows = from.numbers(claim.appended, claim.columns.size());
        claim.aside.assign(rows, rows + claim.appended * claim.columns.size());
      }
      for (uint64_t n = from.number(); n > 0; --n) {
        const std::size_t row = from.number(), column = from.number();
        const std::size_t rows = appends(claim) ? claim.appended : instance_.out_[i].rows;
        if (row >= rows || column >= claim.columns.size() || !claim.columns[column].bytes) throw DoesNotFit{};
        claim.puts.push_back({row, column, from.blob()});
      }
    }
    for (uint64_t n = from.number(); n > 0; --n) {
      Join join{&set_of(from), from.text(), static_cast<int>(from.number()), {}};
      if (join.like >= static_cast<int>(join.set->rows())) throw DoesNotFit{};
      for (uint64_t values = from.number(); values > 0; --values) {
        std::string quantity = from.text();
        const std::size_t column = from.number();
        join.values.push_back({std::move(quantity), column, *from.numbers(1)});
      }
      instance_.joins.push_back(std::move(join));
    }
    for (uint64_t n = from.number(); n > 0; --n) {
      Set& set = set_of(from);
      const uint64_t row = from.number();
      if (row >= set.alive.size()) throw DoesNotFit{};
      instance_.leaves.push_back({&set, static_cast<uint32_t>(row)});
    }
    return fine;
  }

 private:
  // What the kernel has not yet taken from the instance is its own.
  void forget() {
    instance_.events.clear();
    instance_.joins.clear();
    instance_.leaves.clear();
  }

  Set& set_of(ValueReader& from) const {
    Set* set = around_.board->find_set(from.text());
    if (!set) throw DoesNotFit{};
    return *set;
  }

  Instance& instance_;
  Surroundings& around_;
  std::byte *begin_, *half_, *end_;
  std::vector<double*> filled_;  // the cells that the other process fills, a claim each
};

IsolatedStep::IsolatedStep(Instance& instance, Surroundings& around)
    : instance_(instance), around_(around), how_(*instance.isolation()), bytes_(0) {}

void IsolatedStep::start() {
  sets_.clear();
  for (const auto& [name, set] : around_.board->sets()) sets_.emplace_back(set.get(), set->alive);
  bytes_ = std::max({bytes_, least_bytes, 8 * table_bytes(instance_.claims_)});
  process_.reset();
  process_ = std::make_unique<SeparateProcess>(bytes_, [this](std::byte* memory) { serve(memory); });
}

// There: one step.
void IsolatedStep::serve(std::byte* memory) {
  around_.workers = nullptr;  // their threads stayed behind
  Crossing crossing(instance_, around_, memory, bytes_);
  const muster_tick now = crossing.receive();
  crossing.answer(instance_.step_here(now));
}

bool IsolatedStep::knows_the_sets() const {
  const auto& sets = around_.board->sets();
  return std::equal(sets.begin(), sets.end(), sets_.begin(), sets_.end(), [](const auto& now, const auto& known) {
    return now.second.get() == known.first && now.second->alive == known.second;
  });
}

bool IsolatedStep::run(const muster_tick& now) {
  if (given_up_) return keep_values(), true;
  while (true) {
    if (!process_ || !knows_the_sets()) start();
    Crossing crossing(instance_, around_, process_->memory(), bytes_);
    const bool fits = crossing.send(now);
    const std::string how = fits ? process_->call(how_.limit) : "";
    if (!how.empty()) {
      process_.reset();
      if (!goes_on(now, how)) return false;
      if (given_up_) return keep_values(), true;
      continue;
    }
    try {
      const auto fine = fits ? crossing.take() : std::nullopt;
      if (fine) return *fine;
    } catch (const DoesNotFit&) {
      process_.reset();
      instance_.error_ = "its own process overwrote the memory of its answers: it writes beyond what it was given";
      return false;
    }
    process_.reset();
    if (bytes_ >= most_bytes) {
      instance_.error_ = "its rows of one step do not fit into 4 GB, and so not through to its own process";
      return false;
    }
    bytes_ *= 4;
  }
}

// After the end of its process. False: the step has failed.
bool IsolatedStep::goes_on(const muster_tick& now, const std::string& how) {
  const std::string what = "its own process " + how;
  const bool again = restarted_at_ == now.index;
  if (how_.after == AfterCrash::restart && !again) {
    restarted_at_ = now.index;
    instance_.events.push_back("warning: " + what + "; another one takes this step");
    return true;
  }
  if (how_.after == AfterCrash::without) {
    given_up_ = true;
    instance_.events.push_back("warning: " + what +
                               "; the run goes on without it: its tables keep their values, and what it changed on its "
                               "way passes unchanged");
    return true;
  }
  instance_.error_ = what + (again ? ", and so did the one that took its place in this step" : "");
  return false;
}

// What a writer or a part of a sum has published stays; what a stage was given passes.
void IsolatedStep::keep_values() {
  for (std::size_t i = 0; i < instance_.claims_.size(); ++i) {
    Claim& claim = instance_.claims_[i];
    if (!claim.out) continue;
    const muster_in& in = instance_.in_[i];
    const auto width = claim.columns.size();
    double* to = instance_.out_[i].data;
    std::size_t rows = instance_.out_[i].rows;
    if (appends(claim)) {
      const bool passes = claim.lists || claim.kind == MUSTER_MODIFY;
      rows = passes ? in.rows : 0;
      claim.appended = rows;
      claim.aside.resize(rows * width);
      to = claim.aside.data();
    }
    const bool known = in.data && in.rows == rows;
    for (std::size_t cell = 0; cell < rows * width; ++cell) {
      to[cell] = known ? in.data[cell] : 0;
      if (!claim.columns[cell % width].bytes || to[cell] == 0) continue;
      claim.puts.push_back({cell / width, cell % width, claim.in->now().blobs[static_cast<std::size_t>(to[cell]) - 1]});
      to[cell] = 0;
    }
  }
}

}  // namespace muster
