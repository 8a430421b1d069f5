/**
 * @class vtkRadiosityToneMapping
 * @brief Vertex colours of a solved scene: the photographic operator of Reinhard et al. 2002.
 *
 * Input and output are a vtkPolyData of triangles. Reads the point array `Radiosity` (3 float,
 * W/m2); where only `Irradiance` is there, the light itself is coloured. The output adds the point
 * array `Colors` (3 unsigned char, sRGB) and makes it the active scalars. Nothing else changes.
 */
#ifndef vtkRadiosityToneMapping_h
#define vtkRadiosityToneMapping_h

#include "lambertDisplayModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct ToneMappingOptions;
}

class LAMBERTDISPLAY_EXPORT vtkRadiosityToneMapping : public vtkPolyDataAlgorithm {
 public:
  static vtkRadiosityToneMapping* New();
  vtkTypeMacro(vtkRadiosityToneMapping, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Display luminance that the scene's log-average is brought to, (0, 1]; default 0.18.
  void SetKey(double key);
  double GetKey();
  ///@}
  ///@{ Stops (EV) brighter, above 0, or darker; default 0.
  void SetExposure(double exposure);
  double GetExposure();
  ///@}
  ///@{ Keyed luminance that reaches full white; default 0: a hundredth of the lit area may burn
  /// out.
  void SetWhite(double white);
  double GetWhite();
  ///@}

  /// Name of the array that is added.
  static const char* ColorsArrayName() { return "Colors"; }

 protected:
  vtkRadiosityToneMapping();
  ~vtkRadiosityToneMapping() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkRadiosityToneMapping(const vtkRadiosityToneMapping&) = delete;
  void operator=(const vtkRadiosityToneMapping&) = delete;
  std::unique_ptr<lambert::ToneMappingOptions> Options;
};

#endif
