// ODE itself: the only way in which this plugin includes it, and what of it is global.
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
// its exact solver could not settle a contact and left it as it was.)
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
// step runs meanwhile. False where ODE has no memory left.
bool quick_step(dWorldID world, double h, unsigned long seed);

// A way to step on the calling thread, to be outlived by no world that uses it. The one that ODE shares among worlds
// fails where two of them step at once.
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

struct Destroy {
  void operator()(dxWorld* world) const { dWorldDestroy(world); }
  void operator()(dxSpace* space) const { dSpaceDestroy(space); }  // and what is in it
  void operator()(dxJointGroup* group) const { dJointGroupDestroy(group); }
};

}  // namespace muster::ode
