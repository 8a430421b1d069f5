// Ctrl-C: the first asks to stop and keep what is solved, the second ends the program at once.
#pragma once

namespace lambert {

void CatchInterrupt();
bool IsInterrupted();

}  // namespace lambert
