// What goes wrong is thrown by a core and told once, by the shell or the program around it.
#pragma once

#include <stdexcept>
#include <string>

namespace lambert {

/// One clear sentence: what is wrong, where, what to do.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence) : std::runtime_error(sentence) {}
};

/// Thrown where work was cancelled through a progress callback and nothing is worth keeping.
class Cancelled : public Error {
 public:
  Cancelled() : Error("The work was cancelled.") {}
};

}  // namespace lambert
