#include "Interrupt.h"

#include <csignal>

namespace lambert {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void OnInterrupt(int) { interrupted = 1; }

}  // namespace

void CatchInterrupt() {
  struct sigaction action = {};
  action.sa_handler = OnInterrupt;
  action.sa_flags = int(SA_RESETHAND) | SA_RESTART;  // The second signal takes the default way out.
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

bool IsInterrupted() { return interrupted != 0; }

}  // namespace lambert
