// Progress on stderr: a bar on a terminal, lines in a log.
#pragma once

#include <mutex>
#include <string>

#include "Common/Core/Progress.h"
#include "Common/Core/Timer.h"
#include "ProgressStyle.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

class ProgressDisplay {
 public:
  explicit ProgressDisplay(ProgressStyle style);
  ~ProgressDisplay();

  /// Names the stage that begins, and ends the one before. A log hears of a stage when it is done,
  /// so that a failure is one sentence.
  void Begin(const std::string& stage);
  void EndStage();
  /// How far the stage is. Safe to call from any thread.
  void Update(double fraction, const char* detail);
  void EndIteration(const IterationRecord& record);
  /// A line of its own, whatever the style but none.
  void Say(const std::string& sentence);
  /// Clears the bar.
  void Finish();

 private:
  void Line(const std::string& text);

  enum class Mode { Bar, Lines, Silent } mode_;
  std::string stage_;    ///< what the bar says
  std::string lasting_;  ///< the stage that has begun and not ended
  Timer sinceDrawn_;
  bool drawn_ = false;
  std::mutex mutex_;
};

}  // namespace lambert
