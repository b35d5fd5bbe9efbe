#include <unistd.h>

#include "run.h"

// The library is built for AVX2 and FMA. This file is not, and its constructor runs before all others, so that an
// older processor hears a sentence and not "illegal instruction".
#ifdef SATEEN_NEEDS_AVX2
__attribute__((constructor(101))) static void check_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) return;
  static const char message[] =
      "error: this processor has no AVX2 and FMA, which sateen is built for\n"
      "  help: use a processor of 2013 or later, or build with -DSATEEN_ARCH=x86-64 (slower)\n";
  if (write(STDERR_FILENO, message, sizeof message - 1) < 0) _exit(1);
  _exit(1);
}
#endif

int main(int argc, char** argv) {
  return sateen::app::run(argc, argv);
}
