/**
 * @class vtkRadiosityImageWriter
 * @brief Writes a PNG picture of a solved scene, off-screen.
 *
 * Input: a vtkPolyData with `Radiosity` at its points, as a radiosity method or
 * vtkRadiosityToneMapping leaves it; an array `Colors` that is there already is shown as it stands.
 * Light is drawn linear, without any shading of VTK's own, and tone mapped by pixel; faces seen
 * from behind are left out, since a lit back side has faces of its own. Four samples a pixel.
 *
 * Needs an X display; where none answers, an error says so and nothing is written (run under
 * xvfb-run).
 */
#ifndef vtkRadiosityImageWriter_h
#define vtkRadiosityImageWriter_h

#include "lambertDisplayModule.h"
#include "vtkSmartPointer.h"  // for pictures
#include "vtkWriter.h"

class vtkCamera;
class vtkImageData;
class vtkPolyData;
class vtkRadiosityToneMapping;

class LAMBERTDISPLAY_EXPORT vtkRadiosityImageWriter : public vtkWriter {
 public:
  static vtkRadiosityImageWriter* New();
  vtkTypeMacro(vtkRadiosityImageWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Name of the PNG file.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}
  ///@{ Width and height in pixels, 1 to 8192; default 960 x 720.
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}

  ///@{ Where the eye stands, world space, m. Setting any of the four turns AutomaticCamera off.
  void SetCamera(double x, double y, double z, double focalX, double focalY, double focalZ);
  void SetViewUp(double x, double y, double z);
  vtkGetVector3Macro(Position, double);
  vtkGetVector3Macro(FocalPoint, double);
  vtkGetVector3Macro(ViewUp, double);
  ///@}
  ///@{ Vertical field of view in degrees, (0, 180); default 40.
  vtkSetClampMacro(ViewAngle, double, 1e-3, 179);
  vtkGetMacro(ViewAngle, double);
  ///@}
  ///@{ Which axis is up where the view is chosen: x, y, z, or as the scene looks (default): see
  /// lambert::GuessUpAxis.
  enum UpAxes { UP_GUESSED = -1, UP_X, UP_Y, UP_Z };
  vtkSetClampMacro(UpAxis, int, UP_GUESSED, UP_Z);
  vtkGetMacro(UpAxis, int);
  ///@}
  ///@{ A view chosen from the scene (see Documentation/Stages/ToneMapping.md); default on.
  vtkSetMacro(AutomaticCamera, bool);
  vtkGetMacro(AutomaticCamera, bool);
  vtkBooleanMacro(AutomaticCamera, bool);
  ///@}

  /// Where curve, key, exposure and white are set. It adapts to what the picture shows.
  vtkGetObjectMacro(ToneMapping, vtkRadiosityToneMapping);
  ///@{ Exposure of the tone mapping: stops (EV), default 0.
  void SetExposure(double exposure);
  double GetExposure();
  ///@}

  ///@{ The local photographic operator (reinhard2002, 3.2): every place is exposed for its
  /// surround. Default off.
  vtkSetMacro(DodgingAndBurning, bool);
  vtkGetMacro(DodgingAndBurning, bool);
  vtkBooleanMacro(DodgingAndBurning, bool);
  ///@}

  ///@{ Irradiance in false colours beside a labelled scale, in place of what the eye sees: in lux,
  /// or in W/m2 (bands weighted as luminance weighs them). Default off.
  enum FalseColorUnits { NO_FALSE_COLORS, LUX, WATTS_PER_SQUARE_METRE };
  vtkSetClampMacro(FalseColors, int, NO_FALSE_COLORS, WATTS_PER_SQUARE_METRE);
  vtkGetMacro(FalseColors, int);
  ///@}
  ///@{ Ends of the scale, in its unit; default (0, 0): from 0 to a round number that all but a
  /// twentieth of the lit area stays below.
  vtkSetVector2Macro(FalseColorRange, double);
  vtkGetVector2Macro(FalseColorRange, double);
  ///@}
  ///@{ Steps from label to label of the scale, [0, 100]; default 0: 4 to 6, as is round.
  vtkSetClampMacro(FalseColorSteps, int, 0, 100);
  vtkGetMacro(FalseColorSteps, int);
  ///@}
  ///@{ Lines of equal illuminance at the labels of the scale. Default off.
  vtkSetMacro(Isolines, bool);
  vtkGetMacro(Isolines, bool);
  vtkBooleanMacro(Isolines, bool);
  ///@}

  /// True where an X display answers, so that VTK can draw.
  static bool IsDisplayAvailable();

 protected:
  vtkRadiosityImageWriter();
  ~vtkRadiosityImageWriter() override;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  void WriteData() override;

 private:
  vtkRadiosityImageWriter(const vtkRadiosityImageWriter&) = delete;
  void operator=(const vtkRadiosityImageWriter&) = delete;
  void PlaceCamera(vtkPolyData* scene, vtkCamera* camera);
  vtkSmartPointer<vtkImageData> DrawLight(vtkPolyData* scene, vtkCamera* camera);
  vtkSmartPointer<vtkImageData> DrawFalseColors(vtkPolyData* scene, vtkCamera* camera);
  vtkSmartPointer<vtkImageData> DrawColors(vtkPolyData* scene, vtkCamera* camera);
  void WriteImage(vtkImageData* image);

  char* FileName = nullptr;
  int Size[2] = {960, 720};
  double Position[3] = {0, 0, 1};
  double FocalPoint[3] = {0, 0, 0};
  double ViewUp[3] = {0, 1, 0};
  double ViewAngle = 40;
  int UpAxis = UP_GUESSED;
  bool AutomaticCamera = true;
  vtkRadiosityToneMapping* ToneMapping;
  bool DodgingAndBurning = false;
  int FalseColors = NO_FALSE_COLORS;
  double FalseColorRange[2] = {0, 0};
  int FalseColorSteps = 0;
  bool Isolines = false;
};

#endif
