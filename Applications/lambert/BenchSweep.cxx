#include <algorithm>
#include <new>

#include "BenchMethods.h"
#include "BenchRuns.h"
#include "BenchStudies.h"
#include "Common/Core/Error.h"
#include "Common/Core/Timer.h"

namespace lambert {
namespace {

/// A run that takes so many times as long as it was expected to take at most is cut off.
constexpr double kOverrun = 2;

/// One method on its way from coarse to fine.
struct MethodSweep {
  const BenchMethod* method;
  std::vector<double> values;   ///< coarse ones first
  std::vector<double> seconds;  ///< of those that were run; of 0: failed
  bool ended = false;

  /// By how much the next run takes longer than the last, before two have told.
  static constexpr double kUsualGrowth = 4;

  /// True where the next value is worth a run of at most `longest` seconds.
  bool NextFits(double longest) const {
    const size_t done = seconds.size();
    if (ended || done == values.size()) return false;
    if (done == 0) return true;
    const double growth =
        done > 1 ? std::max(1.0, seconds[done - 1] / seconds[done - 2]) : kUsualGrowth;
    return growth * seconds[done - 1] <= longest;
  }
};

class Sweep {
 public:
  Sweep(const BenchArguments& arguments, const BenchScene& scene, const BenchReference& reference,
        BenchTableWriter* table)
      : arguments_(arguments),
        scene_(scene),
        reference_(reference),
        table_(table),
        random_(HashBits(arguments.seed, scene.scene.mesh.triangles.size())) {}

  /// Runs once; returns the seconds, 0 where it failed.
  double Run(const BenchMethod& method, double value, int run) {
    BenchRow row = BeginRow("sweep", scene_, method, value);
    row.run = run;
    row.order = ++order_;
    ForgetPeakMemory();
    try {
      const Scene& scene = method.meshesByItself ? scene_.Coarsest() : scene_.scene;
      const uint64_t seed = HashBits(arguments_.seed, uint64_t(run));
      const double cpuBefore = CpuSeconds();
      const Timer timer;
      const BenchOutcome outcome = method.run(scene, value, seed, [&](double, const char*) {
        return timer.Seconds() < kOverrun * arguments_.longest;
      });
      row.cpu = CpuSeconds() - cpuBefore;
      EnterOutcome(outcome, method, &row);
      row.SetError(MeasureAtReceivers(scene_, reference_, outcome.solution, method.meshesByItself));
    } catch (const std::bad_alloc&) {
      row.note = "The memory does not suffice.";
    } catch (const Cancelled&) {
      row.note = "Cut off: it took longer than " + std::to_string(int(kOverrun)) + " x --longest.";
    } catch (const Error& error) {
      row.note = error.what();
    }
    table_->Append(row);
    Announce(row);
    return row.note.empty() ? row.seconds : 0;
  }

  void FirstRound(std::vector<MethodSweep>* sweeps) {
    std::vector<MethodSweep*> waiting;
    for (;;) {
      waiting.clear();
      for (MethodSweep& sweep : *sweeps) {
        if (sweep.NextFits(arguments_.longest)) waiting.push_back(&sweep);
      }
      if (waiting.empty()) return;
      MethodSweep& next = *waiting[size_t(random_.UniformDouble() * double(waiting.size()))];
      const double seconds = Run(*next.method, next.values[next.seconds.size()], 1);
      if (seconds > 0)
        next.seconds.push_back(seconds);
      else
        next.ended = true;
    }
  }

  void LaterRounds(const std::vector<MethodSweep>& sweeps) {
    struct Planned {
      const BenchMethod* method;
      double value;
      int run;
    };
    std::vector<Planned> plan;
    for (int run = 2; run <= arguments_.runs; ++run) {
      for (const MethodSweep& sweep : sweeps) {
        for (size_t i = 0; i < sweep.seconds.size(); ++i) {
          plan.push_back({sweep.method, sweep.values[i], run});
        }
      }
    }
    Shuffle(&plan, &random_);
    for (const Planned& next : plan) Run(*next.method, next.value, next.run);
  }

 private:
  const BenchArguments& arguments_;
  const BenchScene& scene_;
  const BenchReference& reference_;
  BenchTableWriter* table_;
  Random random_;
  int order_ = 0;
};

}  // namespace

void SweepMethods(const BenchArguments& arguments, const BenchScene& scene,
                  const BenchReference& reference, BenchTableWriter* table) {
  std::vector<MethodSweep> sweeps;
  for (const BenchMethod& method : BenchMethods()) {
    const auto& wanted = arguments.methods;
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), method.name) != wanted.end()) {
      sweeps.push_back({&method, arguments.Values(method.knob), {}});
    }
  }
  Sweep sweep(arguments, scene, reference, table);
  sweep.FirstRound(&sweeps);
  sweep.LaterRounds(sweeps);
}

}  // namespace lambert
