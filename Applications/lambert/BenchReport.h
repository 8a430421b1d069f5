// Tables and charts from the rows of a bench.
#pragma once

#include <string>
#include <vector>

#include "BenchTable.h"

namespace lambert {

/// Writes EqualError.csv (scene, method, error, seconds, speed against the path-traced bake,
/// elements) and Tables.md, the same and the other studies to be read. Throws Error.
void WriteBenchTables(const std::vector<BenchRow>& rows, const std::string& folder);

/// Draws ErrorAgainstTime-<scene>, ErrorAgainstElements-<scene>, TimeAgainstTriangles and
/// Convergence, as far as there are rows for them (elements: of a uniform mesh), as PNG and SVG;
/// needs a display. Throws Error.
void DrawBenchCharts(const std::vector<BenchRow>& rows, const std::string& folder);

}  // namespace lambert
