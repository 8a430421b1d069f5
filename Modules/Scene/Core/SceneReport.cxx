#include "Scene/Core/SceneReport.h"

#include <nlohmann/json.hpp>

namespace lambert {

std::string SceneReportJson(const ReadReport& read, const CleaningReport& cleaning) {
  nlohmann::ordered_json report;
  report["read"] = {{"files", read.files},
                    {"unit", read.unit},
                    {"metresPerUnit", read.metresPerUnit},
                    {"faces", read.faces},
                    {"polygonsTriangulated", read.polygonsTriangulated},
                    {"linesAndPointsIgnored", read.linesAndPointsIgnored},
                    {"materialsClamped", read.materialsClamped},
                    {"transparentMaterials", read.transparentMaterials},
                    {"transparentFaces", read.transparentFaces},
                    {"maskedMaterials", read.maskedMaterials},
                    {"texturesMissing", read.texturesMissing}};
  report["cleaning"] = {{"pointsWelded", cleaning.pointsWelded},
                        {"pointsUnused", cleaning.pointsUnused},
                        {"zeroAreaTriangles", cleaning.zeroAreaTriangles},
                        {"repeatedTriangles", cleaning.repeatedTriangles},
                        {"repeatedOtherMaterial", cleaning.repeatedOtherMaterial},
                        {"facesRewound", cleaning.facesRewound},
                        {"nonOrientablePieces", cleaning.nonOrientablePieces},
                        {"nonManifoldEdges", cleaning.nonManifoldEdges},
                        {"openEdges", cleaning.openEdges},
                        {"normalsMade", cleaning.normalsMade},
                        {"normalsRepaired", cleaning.normalsRepaired},
                        {"invertedEmitters", cleaning.invertedEmitters},
                        {"triangles", cleaning.triangles},
                        {"points", cleaning.points},
                        {"pieces", cleaning.pieces}};
  std::vector<std::string> warnings = read.warnings;
  warnings.insert(warnings.end(), cleaning.warnings.begin(), cleaning.warnings.end());
  report["warnings"] = warnings;
  // Names from files may not be UTF-8: what is not is replaced.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lambert
