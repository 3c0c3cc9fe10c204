#include "scene/wall_kernel.hpp"

namespace muster::scene {

#ifdef __x86_64__

extern const WallKernel x86_64_v2, x86_64_v3, x86_64_v4;

const WallKernels& wall_kernels() {
  static const WallKernels kernels = [] {
    WallKernels found{{&x86_64_v2}, 1};
    if (__builtin_cpu_supports("x86-64-v3")) found.all[found.number++] = &x86_64_v3;
    if (__builtin_cpu_supports("x86-64-v4")) found.all[found.number++] = &x86_64_v4;
    return found;
  }();
  return kernels;
}

#else

extern const WallKernel native;

const WallKernels& wall_kernels() {
  static const WallKernels kernels{{&native}, 1};
  return kernels;
}

#endif

}  // namespace muster::scene
