// The bridge between a vtkPolyData and the triangle mesh of the algorithms. C++ only.
#ifndef vtkTriangleMeshAdapter_h
#define vtkTriangleMeshAdapter_h

#include "Common/Core/TriangleMesh.h"
#include "lambertCommonModule.h"

class vtkPolyData;

namespace lambert {
/// The triangles of `input`, with the arrays of vtkRadiosityArrays that it carries and defaults for
/// the others. Cells that are not triangles are an error: throws lambert::Error.
LAMBERTCOMMON_EXPORT TriangleMesh TriangleMeshFromPolyData(vtkPolyData* input);

/// Fills `output` with the points, triangles and every array of `mesh`.
LAMBERTCOMMON_EXPORT void PolyDataFromTriangleMesh(const TriangleMesh& mesh, vtkPolyData* output);
}  // namespace lambert

#endif
