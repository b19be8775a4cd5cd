#include "growth/row_kernels.h"

namespace pneuma {

namespace detail {
const RowKernels& rowKernelsPortable();
const RowKernels& rowKernelsAvx2();
const RowKernels& rowKernelsAvx512();
}  // namespace detail

namespace {

InstructionSet widest() {
  if (available(InstructionSet::Avx512)) return InstructionSet::Avx512;
  return available(InstructionSet::Avx2) ? InstructionSet::Avx2 : InstructionSet::Portable;
}

const RowKernels*& chosen() {
  static const RowKernels* kernels = &rowKernels(widest());
  return kernels;
}

}  // namespace

bool available(InstructionSet set) {
#ifdef PNEUMA_X86_KERNELS
  switch (set) {
    case InstructionSet::Portable:
      return true;
    case InstructionSet::Avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::Avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
             __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vpopcntdq") != 0;
  }
  return false;
#else
  return set == InstructionSet::Portable;
#endif
}

const RowKernels& rowKernels([[maybe_unused]] InstructionSet set) {
#ifdef PNEUMA_X86_KERNELS
  if (set == InstructionSet::Avx2) return detail::rowKernelsAvx2();
  if (set == InstructionSet::Avx512) return detail::rowKernelsAvx512();
#endif
  return detail::rowKernelsPortable();
}

const RowKernels& rowKernels() { return *chosen(); }

RowKernelChoice::RowKernelChoice(InstructionSet set) : before_(chosen()) {
  chosen() = &rowKernels(set);
}

RowKernelChoice::~RowKernelChoice() { chosen() = before_; }

}  // namespace pneuma
