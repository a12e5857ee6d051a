// The lamplighter program: checks the processor, and passes to the command line everything that
// needs a window or OpenGL.
#include <chrono>
#include <csignal>
#include <cstdio>

#include <unistd.h>

#include "editor/cli/cli.h"
#include "ui/app/backends.h"
#include "ui/app/run.h"

namespace {

// All code is built for x86-64-v3, so that pictures are the same everywhere. On an older processor
// it would stop with an illegal instruction. This check reports the reason instead.
bool processorSuffices() {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2");
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A signal handler may do little more than set a flag.
volatile std::sig_atomic_t interrupted = 0;

std::function<bool()> catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return [] { return interrupted != 0; };
}

int64_t unixTime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (!processorSuffices()) {
    std::fputs("error: this processor has no AVX2 and FMA; use one of 2013 or later\n", stderr);
    return 2;
  }
  lamplighter::Frontend frontend;
  frontend.stopwatch = seconds;
  frontend.catchInterrupts = catchInterrupts;
  frontend.unixTime = unixTime;
  frontend.process = ::getpid();
  frontend.makeBackend = [](const std::string& kind) {
    return lamplighter::makeHeadlessBackend(kind, seconds);
  };
  frontend.runEditor = [&](const lamplighter::EditorOptions& options) {
    return lamplighter::runEditor(options, frontend);
  };
  frontend.runReplay = [](const lamplighter::ReplayOptions& options) {
    return lamplighter::runReplay(options, seconds);
  };
  return lamplighter::runCommandLine(argc, argv, frontend);
}
