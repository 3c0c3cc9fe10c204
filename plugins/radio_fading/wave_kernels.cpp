#include "radio_fading/wave_kernel.hpp"

namespace muster::waves {

#ifdef __x86_64__

extern const WaveKernel x86_64_v2, x86_64_v3, x86_64_v4;

const WaveKernels& wave_kernels() {
  static const WaveKernels kernels = [] {
    WaveKernels found{{&x86_64_v2}, 1};
    if (__builtin_cpu_supports("x86-64-v3")) found.all[found.number++] = &x86_64_v3;
    if (__builtin_cpu_supports("x86-64-v4")) found.all[found.number++] = &x86_64_v4;
    return found;
  }();
  return kernels;
}

#else

extern const WaveKernel native;

const WaveKernels& wave_kernels() {
  static const WaveKernels kernels{{&native}, 1};
  return kernels;
}

#endif

}  // namespace muster::waves
