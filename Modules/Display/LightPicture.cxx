#include "LightPicture.h"

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Display/Core/DodgingAndBurning.h"
#include "OffScreenWindow.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkFloatArray.h"
#include "vtkFramebufferPass.h"
#include "vtkImageData.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityActor.h"
#include "vtkRadiosityArrays.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkTextureObject.h"
#include "vtkTriangleMeshAdapter.h"

#include <algorithm>

namespace lambert {
namespace {
/// Metering sees the picture so many times smaller.
constexpr int kMeteringShrink = 4;
/// Rows of pixels that a thread develops at a time.
constexpr int kGrain = 16;

/// The usual passes of opaque geometry, into floats.
vtkSmartPointer<vtkFramebufferPass> PassIntoFloats() {
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(lights);
  passes->AddItem(opaque);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  auto pass = vtkSmartPointer<vtkFramebufferPass>::New();
  pass->SetDelegatePass(camera);
  pass->SetColorFormat(vtkTextureObject::Float32);
  return pass;
}

LightImage ReadLight(vtkTextureObject* texture, int width, int height) {
  unsigned int size[2] = {static_cast<unsigned int>(width), static_cast<unsigned int>(height)};
  vtkIdType gaps[2] = {0, 0};
  std::vector<float> bands(4 * static_cast<size_t>(width) * static_cast<size_t>(height));
  const auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  if (!buffer || !buffer->Download2D(VTK_FLOAT, bands.data(), size, 4, gaps)) {
    throw Error("The picture could not be read back from a frame buffer of floats.");
  }
  LightImage image{width, height, std::vector<Spectrum>(bands.size() / 4)};
  for (size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
    const float* band = bands.data() + 4 * pixel;
    image.pixels[pixel] = {band[0], band[1], band[2]};
  }
  return image;
}

/// Mean luminance of blocks of `samples` x `samples` pixels.
std::vector<float> BlockLuminances(const LightImage& light, int samples) {
  const int width = light.width / samples, height = light.height / samples;
  std::vector<float> means(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height * samples; ++y) {
    for (int x = 0; x < width * samples; ++x) {
      means[static_cast<size_t>(y / samples * width + x / samples)] +=
          Luminance(light.pixels[static_cast<size_t>(y * light.width + x)]) /
          static_cast<float>(samples * samples);
    }
  }
  return means;
}
}  // namespace

LightImage DrawLight(vtkPolyData* mesh, vtkCamera* camera, int width, int height) {
  vtkNew<vtkRadiosityActor> actor;
  actor->SetInputData(mesh);
  actor->LinearLightOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const auto pass = PassIntoFloats();
  renderer->SetPass(pass);
  const auto window = OffScreenWindow(width, height);
  window->AddRenderer(renderer);
  renderer->SetActiveCamera(camera);
  renderer->ResetCameraClippingRange();
  window->Render();
  const LightImage image = ReadLight(pass->GetColorTexture(), width, height);
  pass->ReleaseGraphicsResources(window);
  return image;
}

std::vector<LuminanceSample> MeterLight(vtkPolyData* mesh, vtkCamera* camera, int width,
                                        int height) {
  // The lamps out.
  const char* name = vtkRadiosityArrays::Radiosity();
  vtkNew<vtkFloatArray> radiosity;
  radiosity->DeepCopy(mesh->GetPointData()->GetArray(name));
  radiosity->SetName(name);
  const std::vector<LuminanceSample> points =
      LuminanceSamples(TriangleMeshFromPolyData(mesh),
                       std::vector<Spectrum>(static_cast<size_t>(mesh->GetNumberOfPoints())));
  for (size_t point = 0; point < points.size(); ++point) {
    if (points[point].weight == 0) {
      radiosity->SetTuple3(static_cast<vtkIdType>(point), 0, 0, 0);
    }
  }

  // A sample a pixel.
  vtkNew<vtkPolyData> withoutLamps;
  withoutLamps->ShallowCopy(mesh);
  withoutLamps->GetPointData()->AddArray(radiosity);
  const LightImage picture = DrawLight(withoutLamps, camera, std::max(1, width / kMeteringShrink),
                                       std::max(1, height / kMeteringShrink));
  std::vector<LuminanceSample> samples;
  for (const Spectrum& light : picture.pixels) {
    samples.push_back({Luminance(light), 1});
  }
  return samples;
}

vtkSmartPointer<vtkImageData> Develop(const LightImage& light, const ToneMapping& toneMapping,
                                      double key, bool local, int samples) {
  // What the eye adapts to about each pixel.
  const int width = light.width / samples;
  std::vector<float> surrounds;
  if (local) {
    surrounds = AdaptingSurrounds(BlockLuminances(light, samples), width, light.height / samples,
                                  toneMapping.Scale(), key);
  }

  // Its code.
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(light.width, light.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  ParallelForEach(light.height, kGrain, [&](int64_t y) {
    for (int64_t x = 0; x < light.width; ++x) {
      const size_t pixel = static_cast<size_t>(y * light.width + x);
      const Spectrum& shown = light.pixels[pixel];
      const auto codes = ToneMapping::Codes(
          local ? toneMapping.Apply(
                      shown, surrounds[static_cast<size_t>(y / samples * width + x / samples)])
                : toneMapping.Apply(shown));
      std::copy(codes.begin(), codes.end(), bytes + 3 * pixel);
    }
  });
  return image;
}
}  // namespace lambert
