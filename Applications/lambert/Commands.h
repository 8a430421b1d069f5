// The commands. They throw lambert::Error for what goes wrong and return the exit code.
#pragma once

#include "SolveArguments.h"

namespace lambert {

int Solve(const SolveArguments& arguments);
int Info(const InfoArguments& arguments);
int Atlas(const AtlasArguments& arguments);

}  // namespace lambert
