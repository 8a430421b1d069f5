// lambert: solves scenes from the command line. Exit 0 done, 1 failed, 2 wrong usage.
#include <vtkLogger.h>
#include <vtkObject.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <new>
#include <string>

#include "BenchArguments.h"
#include "Commands.h"
#include "Common/Core/Error.h"

namespace {

constexpr int kFailed = 1, kWrongUsage = 2;

/// What it quotes from a file may hold anything; it stays on one line.
int Complain(std::string sentence, int exitCode) {
  std::replace_if(
      sentence.begin(), sentence.end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
  std::fprintf(stderr, "lambert: %s\n", sentence.c_str());
  return exitCode;
}

/// Throws CLI::ValidationError where an option or file is given as nothing, as by a variable of a
/// script that is empty.
void RequireValues(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (!value.empty()) continue;
      throw CLI::ValidationError(option->get_name(),
                                 "is given an empty value; give it one or leave it out");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  // Commands and their options.
  CLI::App app(
      "Lambert computes the diffuse global illumination of scenes by hierarchical radiosity.",
      "lambert");
  app.set_version_flag("--version", "lambert " LAMBERT_VERSION);
  app.require_subcommand(1);
  lambert::SolveArguments solve;
  lambert::InfoArguments info;
  lambert::AtlasArguments atlas;
  lambert::BenchArguments bench;
  CLI::App* solveCommand = app.add_subcommand("solve", "Light a scene");
  CLI::App* infoCommand = app.add_subcommand("info", "Say what a scene holds");
  CLI::App* benchCommand = app.add_subcommand("bench", "Chart methods: error, time, elements");
  CLI::App* atlasCommand = app.add_subcommand("atlas", "Lay a scene flat for light maps");
  solve.AddTo(solveCommand);
  info.AddTo(infoCommand);
  bench.AddTo(benchCommand);
  atlas.AddTo(atlasCommand);
  try {
    app.parse(argc, argv);
    for (const CLI::App* command : app.get_subcommands()) RequireValues(*command);
    if (*solveCommand) solve.Check();
    if (*benchCommand) bench.Check();
    if (*atlasCommand) atlas.Check();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUsage;
  }

  // Whatever fails says so in one sentence of ours.
  vtkObject::GlobalWarningDisplayOff();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  try {
    if (*benchCommand) return lambert::Bench(bench);
    if (*atlasCommand) return lambert::Atlas(atlas);
    return *infoCommand ? lambert::Info(info) : lambert::Solve(solve);
  } catch (const lambert::Cancelled&) {
    return Complain("Interrupted before the first iteration; nothing was written.", kFailed);
  } catch (const std::bad_alloc&) {
    return Complain("The memory does not suffice.", kFailed);
  } catch (const std::exception& error) {
    return Complain(error.what(), kFailed);
  }
}
