// MuJoCo and its global state: the only header of this plugin that includes it.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace muster::mujoco {

static_assert(sizeof(mjtNum) == sizeof(double), "Debian's MuJoCo is of double precision");

// While any is alive, MuJoCo's errors are std::runtime_error and its warnings are counted: it neither ends the process
// nor writes a file. The last one takes its handlers away: MuJoCo has its own then.
class Library {
 public:
  Library();
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

// Counts MuJoCo's warnings on the calling thread, from construction on, and keeps the first one.
class Warnings {
 public:
  Warnings();
  ~Warnings();
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  int count = 0;
  std::string first;
};

struct Destroy {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, Destroy>;
using Data = std::unique_ptr<mjData, Destroy>;

// Compiles an MJCF text. Throws std::runtime_error with MuJoCo's words.
Model compile(const std::string& mjcf);
Data data_of(const mjModel* model);

// Calls `work`, which may use MuJoCo, while nobody compiles: the compiler sets handlers of its own for the process.
void at_work(void (*work)(void*), void* with);

template <class Work>
void guarded(Work work) {
  at_work([](void* with) { (*static_cast<Work*>(with))(); }, &work);
}

}  // namespace muster::mujoco
