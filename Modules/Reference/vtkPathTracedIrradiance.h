/**
 * @class vtkPathTracedIrradiance
 * @brief Irradiance by path tracing: at the vertices of a mesh, or at points of your own.
 *
 * Input port 0: the scene, as every vtkRadiosityAlgorithm takes it. Without points the filter is a
 * method like the others: output port 0 is the mesh as it is, a triangle for each lit side, with
 * `Irradiance` and `Radiosity` at its points; ports 1 and 2 as the contract has them. A vertex is
 * traced a thousandth of the way into its triangles, so that corners leak no light.
 *
 * With points on input port 2 (SetPointsConnection, SetPointsData) light is asked for there
 * instead: output port 0 is that data with `Irradiance` and `StandardError` (3 float, W/m2; the
 * error of the mean) at its points, whatever its cells; port 1 is empty, port 2 the scene as it
 * came. The points are probes, texels, vertices of another mesh: each needs its normal in the
 * active Normals, which the irradiance is for. The array `GeometricNormals` (3 float), where there
 * is one, gives the normals whose hemispheres see light; else those are the same. A point on a
 * surface sees what its normal faces; a point without a normal (zero) receives nothing. Points at
 * corners of a closed mesh may see through it: draw them in.
 *
 * AbortExecute ends a run and nothing is delivered.
 */
#ifndef vtkPathTracedIrradiance_h
#define vtkPathTracedIrradiance_h

#include "lambertReferenceModule.h"
#include "vtkRadiosityAlgorithm.h"

class LAMBERTREFERENCE_EXPORT vtkPathTracedIrradiance : public vtkRadiosityAlgorithm {
 public:
  static vtkPathTracedIrradiance* New();
  vtkTypeMacro(vtkPathTracedIrradiance, vtkRadiosityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Paths a lit side of a vertex, at least 1; paths a point, at least 2, rounded up to a
  ///multiple
  /// of 16. Default 256.
  vtkSetMacro(Samples, int);
  vtkGetMacro(Samples, int);
  ///@}
  ///@{ Another seed, another choice of paths; default 1.
  vtkSetMacro(Seed, vtkTypeUInt64);
  vtkGetMacro(Seed, vtkTypeUInt64);
  ///@}

  ///@{ The points of input port 2.
  void SetPointsConnection(vtkAlgorithmOutput* output);
  void SetPointsData(vtkDataObject* points);
  ///@}

 protected:
  vtkPathTracedIrradiance();
  ~vtkPathTracedIrradiance() override = default;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkPathTracedIrradiance(const vtkPathTracedIrradiance&) = delete;
  void operator=(const vtkPathTracedIrradiance&) = delete;

  int EstimateAtPoints(vtkInformationVector** inputs, vtkInformationVector* outputs);

  int Samples;
  vtkTypeUInt64 Seed;
};

#endif
