// Where the time of a run goes: wall-clock seconds by stage.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "Common/Core/Timer.h"

namespace lambert {

class StageSeconds {
 public:
  /// What `work` returns, which may be what cannot be moved; its seconds, and those until it threw,
  /// are added to the stage.
  template <class Work>
  decltype(auto) Time(const char* stage, const Work& work) {
    const Lap lap{*this, stage};
    return work();
  }
  void Add(const std::string& stage, double seconds) {
    for (auto& [name, sum] : stages_) {
      if (name == stage) {
        sum += seconds;
        return;
      }
    }
    stages_.emplace_back(stage, seconds);
  }
  /// Names and seconds, in the order in which stages first ended.
  const std::vector<std::pair<std::string, double>>& All() const { return stages_; }

 private:
  struct Lap {
    StageSeconds& seconds;
    const char* stage;
    Timer timer = {};
    ~Lap() { seconds.Add(stage, timer.Seconds()); }
  };
  std::vector<std::pair<std::string, double>> stages_;
};

}  // namespace lambert
