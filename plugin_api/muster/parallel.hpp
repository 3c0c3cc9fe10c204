// Parts of one step on the threads of the run.
#pragma once

#include <cstddef>
#include <exception>
#include <muster/plugin.hpp>
#include <vector>

namespace muster {

// Calls body(i) for each i below `count`, on the run's threads and in any order; returns when all are done. Bodies call
// nothing of the step, and none writes data that another reads or writes. Of several exceptions, that of the lowest i
// is rethrown here.
template <class Body>
void each(const Step& k, std::size_t count, const Body& body) {
  struct Work {
    const Body& body;
    std::vector<std::exception_ptr> thrown;

    static void one(void* of, uint32_t i) noexcept {
      Work& work = *static_cast<Work*>(of);
      try {
        work.body(std::size_t{i});
      } catch (...) {
        work.thrown[i] = std::current_exception();
      }
    }
  } work{body, std::vector<std::exception_ptr>(count)};
  const muster_host* host = k.host();
  if (host->size >= offsetof(muster_host, each) + sizeof host->each) {
    host->each(host, static_cast<uint32_t>(count), Work::one, &work);
  } else {  // an older kernel without `each`
    for (std::size_t i = 0; i < count; ++i) Work::one(&work, static_cast<uint32_t>(i));
  }
  for (const std::exception_ptr& thrown : work.thrown) {
    if (thrown) std::rethrow_exception(thrown);
  }
}

}  // namespace muster
