// ODE and its global state: the only header of this plugin that includes it.
#pragma once

#include <ode/ode.h>

#include <memory>

namespace muster::ode {

static_assert(sizeof(dReal) == sizeof(double), "Debian's ODE is of double precision");

// Keeps ODE initialised while any user is alive, and its messages away from the terminal.
class Library {
 public:
  Library();
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

// Counts the messages that ODE prints about steps of the calling thread, from construction on. ("LCP internal error":
// its exact solver could not settle a contact and left it unchanged.)
class Complaints {
 public:
  Complaints();
  ~Complaints();
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;
  int count() const { return count_; }

 private:
  int count_ = 0;
};

// dWorldQuickStep shuffles constraints by a generator that all worlds share: it begins at `seed`, and no other quick
// step runs meanwhile. False where ODE is out of memory.
bool quick_step(dWorldID world, double h, unsigned long seed);

// Threading of ODE for steps on the calling thread; must outlive the worlds that use it. ODE's default, shared among
// worlds, fails where two of them step at once.
class OwnThread {
 public:
  OwnThread();
  ~OwnThread();
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;
  void carry(dWorldID world) const;

 private:
  dThreadingImplementationID made_;
};

// An assertion of ODE's did not hold and ended a step with an exception, its structures half changed: destroying them
// would end the process, so that they are left to its end.
bool has_given_up();

struct Destroy {
  void operator()(dxWorld* world) const {
    if (!has_given_up()) dWorldDestroy(world);
  }
  void operator()(dxSpace* space) const {  // and its contents
    if (!has_given_up()) dSpaceDestroy(space);
  }
  void operator()(dxJointGroup* group) const {
    if (!has_given_up()) dJointGroupDestroy(group);
  }
};

}  // namespace muster::ode
