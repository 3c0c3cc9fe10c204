#include "library.hpp"

#include <array>
#include <clocale>
#include <cstring>
#include <locale>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>

namespace muster::mujoco {

namespace {

std::mutex global;  // guards the count of users
int users = 0;
std::shared_mutex compiling;  // held alone by who compiles, shared by who steps
thread_local Warnings* counted = nullptr;

// MuJoCo expects that this does not return. Its frames hold nothing that must be freed, and Debian builds them with
// tables for unwinding.
[[noreturn]] void fail(const char* message) { throw std::runtime_error(std::string("MuJoCo: ") + message); }

void count(const char* message) {
  if (!counted) return;
  if (counted->count++ == 0) counted->first = message;
}

// MuJoCo reads numbers with streams of the program's locale, whose decimal point may be a comma. While this lives it is
// the classic one; nothing is touched where it is so anyway.
class ClassicLocale {
 public:
  ClassicLocale() : own_(std::locale()), of_c_(std::setlocale(LC_ALL, nullptr)) {
    if (is_other_) std::locale::global(std::locale::classic());
  }
  ~ClassicLocale() {
    if (!is_other_) return;
    std::locale::global(own_);
    std::setlocale(LC_ALL, of_c_.c_str());
  }
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
  std::locale own_;
  std::string of_c_;
  bool is_other_ = own_ != std::locale::classic();
};

// MuJoCo has one pair of handlers in a process, and simulations that run side by side may each have a copy of this
// library: whoever works puts its own in their place, and takes away none but its own. Both are as good to MuJoCo, but
// a warning goes to those whose handler stands there.
using Handler = void (*)(const char*);

void put(Handler& place, Handler handler) {
  if (__atomic_load_n(&place, __ATOMIC_RELAXED) != handler) __atomic_store_n(&place, handler, __ATOMIC_RELAXED);
}

void take_away(Handler& place, Handler handler) {
  __atomic_compare_exchange_n(&place, &handler, nullptr, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
}

void set_handlers() {
  put(mju_user_error, fail);
  put(mju_user_warning, count);
}

}  // namespace

Library::Library() {
  const std::lock_guard<std::mutex> lock(global);
  if (users++ == 0) set_handlers();
}

Library::~Library() {
  const std::lock_guard<std::mutex> lock(global);
  if (--users) return;
  take_away(mju_user_error, fail);
  take_away(mju_user_warning, count);
}

Warnings::Warnings() { counted = this; }
Warnings::~Warnings() { counted = nullptr; }

Model compile(const std::string& mjcf) {
  constexpr const char* name = "world.xml";
  const std::unique_lock<std::shared_mutex> alone(compiling);
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(mjcf.size())) != 0)
    throw std::runtime_error("MuJoCo has no memory left for a world of " + std::to_string(mjcf.size()) + " bytes");
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], mjcf.data(), mjcf.size());
  std::array<char, 1000> wrong{};
  const ClassicLocale classic;
  Model made(mj_loadXML(name, files.get(), wrong.data(), static_cast<int>(wrong.size())));
  mj_deleteVFS(files.get());
  mj_freeLastXML();
  set_handlers();  // the compiler's own may have taken their place
  if (!made) throw std::runtime_error("MuJoCo refuses the world: " + std::string(wrong.data()));
  return made;
}

Data data_of(const mjModel* model) {
  Data made(mj_makeData(model));
  if (!made) throw std::runtime_error("MuJoCo has no memory left for a world's state");
  return made;
}

void at_work(void (*work)(void*), void* with) {
  const std::shared_lock<std::shared_mutex> shared(compiling);
  set_handlers();
  work(with);
}

}  // namespace muster::mujoco
