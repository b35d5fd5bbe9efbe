// With SATEEN_FLOAT_TRAPS set, every invalid operation and every division by zero of a test program ends it where it
// happens. Compiled into the programs of the model's rooms, in the sanitized build, which is made with
// -ftrapping-math: elsewhere the compiler may compute ahead what is then not wanted, and a trap would tell nothing.
#include <dlfcn.h>
#include <fenv.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <ucontext.h>

#include <cstdlib>
#include <cstring>

namespace {

constexpr unsigned masks = 0x1f80, invalid_and_division = 0x0280, flags = 0x3f;  // of the control register MXCSR
constexpr greg_t single_step = 0x100;

struct sigaction before;

// Embree divides by the zeros of a ray's direction on purpose. Its instruction is run without traps, and they come
// back with the next.
void on_trap(int signal, siginfo_t* info, void* context) {
  ucontext_t* const state = static_cast<ucontext_t*>(context);
  Dl_info place{};
  const auto at = reinterpret_cast<void*>(state->uc_mcontext.gregs[REG_RIP]);
  if (dladdr(at, &place) && place.dli_fname && std::strstr(place.dli_fname, "libembree")) {
    state->uc_mcontext.fpregs->mxcsr |= masks;
    state->uc_mcontext.gregs[REG_EFL] |= single_step;
  } else if (before.sa_flags & SA_SIGINFO) {
    before.sa_sigaction(signal, info, context);
  } else {
    std::abort();
  }
}

void on_next_instruction(int, siginfo_t*, void* context) {
  ucontext_t* const state = static_cast<ucontext_t*>(context);
  unsigned& mxcsr = state->uc_mcontext.fpregs->mxcsr;
  mxcsr = (mxcsr | masks) & ~(invalid_and_division | flags);
  state->uc_mcontext.gregs[REG_EFL] &= ~single_step;
}

struct FloatTraps : testing::Environment {
  void SetUp() override {
    struct sigaction action {};
    action.sa_flags = SA_SIGINFO;
    action.sa_sigaction = on_next_instruction;
    sigaction(SIGTRAP, &action, nullptr);
    action.sa_sigaction = on_trap;
    sigaction(SIGFPE, &action, &before);
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
  }
  void TearDown() override { fedisableexcept(FE_ALL_EXCEPT); }
};

[[maybe_unused]] const testing::Environment* const registered =
    std::getenv("SATEEN_FLOAT_TRAPS") ? testing::AddGlobalTestEnvironment(new FloatTraps) : nullptr;

TEST(FloatTraps, EndTheProgramWhereNumbersGoWrong) {
  if (!std::getenv("SATEEN_FLOAT_TRAPS")) GTEST_SKIP() << "SATEEN_FLOAT_TRAPS is not set";
  volatile double zero = 0;
  [[maybe_unused]] volatile double result = 0;
  EXPECT_DEATH(result = 1 / zero, "");
  EXPECT_DEATH(result = zero / zero, "");
}

}  // namespace
