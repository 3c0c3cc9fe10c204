#include "library_copy.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "elf.hpp"

namespace muster {
namespace {

constexpr std::size_t largest = std::size_t{1} << 30;  // [bytes] more than any plugin with its debug information

std::string reason(int error) { return std::generic_category().message(error); }

// A file descriptor that closes itself.
struct Descriptor {
  int number;
  explicit Descriptor(int n) : number(n) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int release() { return std::exchange(number, -1); }
};

// The size of a file, checked to be that of a regular file within the limit.
std::size_t checked_size(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0) throw Refusal("cannot be read: " + reason(errno));
  if (S_ISDIR(status.st_mode)) throw Refusal("is a directory; expected a shared library");
  if (!S_ISREG(status.st_mode)) throw Refusal("is a device or a pipe; expected a shared library");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > largest) throw Refusal(fmt::format("has {} bytes; a library may have at most {}", size, largest));
  return size;
}

// Copies all that there is: a file that shrinks meanwhile is later found to be truncated.
std::size_t copy(int from, int to, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::sendfile(to, from, nullptr, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Refusal("cannot be read: " + reason(errno));
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

}  // namespace

LibraryCopy::LibraryCopy(const std::filesystem::path& file) {
  const Descriptor from(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // opening a pipe must not block
  if (from.number < 0) throw Refusal("cannot be read: " + reason(errno));
  const std::size_t size = checked_size(from.number);
  Descriptor to(::memfd_create(file.filename().c_str(), MFD_CLOEXEC));
  if (to.number < 0) throw Refusal("cannot be copied to memory: " + reason(errno));
  size_ = copy(from.number, to.number, size);
  if (size_ > 0) {
    void* mapped = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, to.number, 0);
    if (mapped == MAP_FAILED) throw Refusal("cannot be copied to memory: " + reason(errno));
    data_ = static_cast<const char*>(mapped);
  }
  file_ = to.release();
}

LibraryCopy::~LibraryCopy() {
  if (data_) ::munmap(const_cast<char*>(data_), size_);
  if (file_ >= 0) ::close(file_);
}

std::string LibraryCopy::name() const {
  // This process's id in /proc, which differs from getpid() where /proc shows another namespace.
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self");
  return fmt::format("/proc/{}/fd/{}", self.native(), file_);
}

}  // namespace muster
