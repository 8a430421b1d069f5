#include "ProgressDisplay.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace lambert {
namespace {

constexpr int kBarWidth = 30;
constexpr double kSecondsBetweenDrawings = 0.1;
constexpr const char* kClearLine = "\r\033[K";

}  // namespace

ProgressDisplay::ProgressDisplay(ProgressStyle style)
    : mode_(style == ProgressStyle::None                            ? Mode::Silent
            : style == ProgressStyle::Auto && isatty(STDERR_FILENO) ? Mode::Bar
                                                                    : Mode::Lines) {}

ProgressDisplay::~ProgressDisplay() { Finish(); }

void ProgressDisplay::Begin(const std::string& stage) {
  EndStage();
  stage_ = lasting_ = stage;
  if (mode_ == Mode::Bar) {
    sinceDrawn_.Restart();
    std::fprintf(stderr, "%s%s", kClearLine, stage.c_str());
    drawn_ = true;
  }
}

void ProgressDisplay::Update(double fraction, const char* detail) {
  if (mode_ != Mode::Bar) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (sinceDrawn_.Seconds() < kSecondsBetweenDrawings) return;
  sinceDrawn_.Restart();
  const double clamped = std::min(1., std::max(0., fraction));
  const int filled = int(clamped * kBarWidth);
  std::fprintf(stderr, "%s[%s%s] %3.0f %%  %s", kClearLine,
               std::string(size_t(filled), '#').c_str(),
               std::string(size_t(kBarWidth - filled), '.').c_str(), clamped * 100,
               detail && *detail ? detail : stage_.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressDisplay::EndIteration(const IterationRecord& record) {
  char text[160];
  std::snprintf(text, sizeof(text),
                "iteration %d: %lld elements, %lld links, %lld rays, change %.2g", record.iteration,
                static_cast<long long>(record.elements), static_cast<long long>(record.links),
                static_cast<long long>(record.rays), record.change);
  stage_ = text;
  if (record.error >= 0) stage_ += ", verified error " + std::to_string(record.error);
  if (mode_ == Mode::Lines) Line(stage_);
}

void ProgressDisplay::Say(const std::string& sentence) {
  if (mode_ == Mode::Silent) return;
  Finish();
  Line(sentence);
}

void ProgressDisplay::EndStage() {
  if (mode_ == Mode::Lines && !lasting_.empty()) Line(lasting_ + " done");
  lasting_.clear();
}

void ProgressDisplay::Finish() {
  if (drawn_) std::fputs(kClearLine, stderr);
  drawn_ = false;
}

void ProgressDisplay::Line(const std::string& text) {
  std::fprintf(stderr, "%7.1f s  %s\n", SecondsSinceProcessStart(), text.c_str());
}

}  // namespace lambert
