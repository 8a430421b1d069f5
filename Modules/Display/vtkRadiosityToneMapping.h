/**
 * @class vtkRadiosityToneMapping
 * @brief Vertex colours of a solved scene: exposure, a tone curve, sRGB.
 *
 * Input and output are a vtkPolyData of triangles. Reads the point array `Radiosity` (3 float,
 * W/m2); where only `Irradiance` is there, the light itself is coloured. The output adds the point
 * array `Colors` (3 unsigned char, sRGB) and makes it the active scalars. Nothing else changes.
 * Whatever else draws light (vtkRadiosityImageWriter) takes its options from one of these.
 */
#ifndef vtkRadiosityToneMapping_h
#define vtkRadiosityToneMapping_h

#include "lambertDisplayModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options
#include <vector>  // for samples

namespace lambert {
class SteadyAdaptation;
class ToneMapping;
struct LuminanceSample;
struct ToneMappingOptions;
}  // namespace lambert

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
  ///@{ Keyed luminance that reaches full white, [0, inf); default 0: of the photographic curve, a
  /// hundredth of the lit area may burn out; of the filmic one, 5.6. The linear one has none.
  void SetWhite(double white);
  double GetWhite();
  ///@}
  ///@{ What compresses luminance: the photographic operator of reinhard2002 (default), nothing, or
  /// film as hable2010 draws it.
  enum Curves { PHOTOGRAPHIC, LINEAR, FILMIC };
  void SetCurve(int curve);
  int GetCurve();
  void SetCurveToPhotographic() { this->SetCurve(PHOTOGRAPHIC); }
  void SetCurveToLinear() { this->SetCurve(LINEAR); }
  void SetCurveToFilmic() { this->SetCurve(FILMIC); }
  ///@}
  ///@{ Exposure value at ISO 100 of a camera that does not adapt: 2^EV / 8 cd/m2 is brought to the
  /// key. Default NaN: the log-average of the scene is.
  void SetExposureValue(double exposureValue);
  double GetExposureValue();
  ///@}
  ///@{ Stops that the adaptation moves at most from one update to the next, so that a picture does
  /// not pump while its solution converges, [0, inf); default 0: it is measured anew each time.
  /// Setting it forgets what was seen.
  void SetSteadyStops(double stops);
  vtkGetMacro(SteadyStops, double);
  ///@}

  /// The operator, adapted to `samples`, for what draws by itself. Throws lambert::Error. C++ only.
  lambert::ToneMapping Adapt(const std::vector<lambert::LuminanceSample>& samples);
  ///@{ All options but SteadyStops. C++ only.
  void SetOptions(const lambert::ToneMappingOptions& options);
  const lambert::ToneMappingOptions& GetOptions() const { return *this->Options; }
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
  double SteadyStops = 0;
  std::unique_ptr<lambert::SteadyAdaptation> Steady;
};

#endif
