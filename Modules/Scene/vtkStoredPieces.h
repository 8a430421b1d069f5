// The files of VTK that scenes are read from: VTP, and VTPC, which names the VTP files of its
// pieces. C++ only.
#ifndef vtkStoredPieces_h
#define vtkStoredPieces_h

#include "lambertSceneModule.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace lambert {
struct StoredPiece {
  std::string file;        ///< a VTP
  std::string name;        ///< that a collection gives it, if any
  std::string collection;  ///< the VTPC that names it, if any
};

/// True for names that end in .vtp or .vtpc, in any case.
LAMBERTSCENE_EXPORT bool IsStoredScene(const std::string& file);

/// The pieces of a VTPC in its order; a VTP is its own. Throws Error, one clear sentence, where the
/// collection is damaged or names no piece, or one that is not there or no poly data.
LAMBERTSCENE_EXPORT std::vector<StoredPiece> FindStoredPieces(const std::string& file);

/// Throws Error, one clear sentence, where the file of the piece is damaged.
LAMBERTSCENE_EXPORT vtkSmartPointer<vtkPolyData> ReadStoredPiece(const StoredPiece& piece);
}  // namespace lambert

#endif
