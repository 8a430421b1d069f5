// Compares a picture with its baseline: lambertCompareImages IMAGE BASELINE. Exit 0 where they
// agree; else 1, and the difference is left beside the picture as NAME-difference.png.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> codes;  ///< three a pixel, [0, 255]
  float At(int x, int y, int band) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return codes[size_t((y * width + x) * 3 + band)];
  }
};

/// Rasterizers differ by a pixel along edges and by a code in rounding. Pictures are therefore
/// averaged over 3 x 3 pixels before they are compared: an edge moved by half a pixel between codes
/// 0 and 255 then changes some 43 codes along a line, which the mean forgives and a lost shadow or
/// a darker wall does not.
constexpr double kMeanTolerance =
    1.0;  ///< codes, mean over all pixels and bands: 0.4 % of full white
constexpr float kPixelTolerance = 48;  ///< codes, of an averaged pixel
constexpr double kPixelsOutside =
    0.001;  ///< share of pixels that may exceed it (corners of thin objects)

Picture Read(const char* fileName) {
  vtkNew<vtkPNGReader> reader;
  Picture picture;
  if (!reader->CanReadFile(fileName)) {
    std::fprintf(stderr, "%s is missing or no PNG.\n", fileName);
    return picture;
  }
  reader->SetFileName(fileName);
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  picture.width = data->GetDimensions()[0];
  picture.height = data->GetDimensions()[1];
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int band = 0; band < 3; ++band) {
        const int component = std::min(band, data->GetNumberOfScalarComponents() - 1);
        picture.codes.push_back(data->GetScalarComponentAsFloat(x, y, 0, component));
      }
    }
  }
  return picture;
}

Picture Average(const Picture& picture) {
  Picture average = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int band = 0; band < 3; ++band) {
        float sum = 0;
        for (int k = 0; k < 9; ++k) sum += picture.At(x + k % 3 - 1, y + k / 3 - 1, band);
        average.codes[size_t((y * picture.width + x) * 3 + band)] = sum / 9;
      }
    }
  }
  return average;
}

/// True where the pictures agree; `difference` gets the absolute differences.
bool Agree(const Picture& image, const Picture& baseline, Picture* difference,
           double meanTolerance = kMeanTolerance) {
  if (image.codes.empty() || image.width != baseline.width || image.height != baseline.height) {
    std::fprintf(stderr, "The pictures measure %d x %d and %d x %d pixels.\n", image.width,
                 image.height, baseline.width, baseline.height);
    return false;
  }
  const Picture a = Average(image), b = Average(baseline);
  *difference = a;
  double sum = 0;
  size_t outside = 0;
  for (size_t i = 0; i < a.codes.size(); ++i) {
    difference->codes[i] = std::abs(a.codes[i] - b.codes[i]);
    sum += difference->codes[i];
    outside += difference->codes[i] > kPixelTolerance;
  }
  const double mean = sum / double(a.codes.size()),
               share = double(outside) / double(a.codes.size());
  std::printf("mean difference %.3f codes (at most %.3f), outside %.5f (at most %.5f)\n", mean,
              meanTolerance, share, kPixelsOutside);
  return mean <= meanTolerance && share <= kPixelsOutside;
}

void WriteDifference(const Picture& difference, std::string fileName) {
  fileName.replace(fileName.size() - std::min<size_t>(4, fileName.size()), std::string::npos,
                   "-difference.png");
  vtkNew<vtkImageData> data;
  data->SetDimensions(difference.width, difference.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* codes = static_cast<unsigned char*>(data->GetScalarPointer());
  std::transform(difference.codes.begin(), difference.codes.end(), codes,
                 [](float code) { return static_cast<unsigned char>(std::min(255.f, 4 * code)); });
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(fileName.c_str());
  writer->Write();
}

/// A lit disc on a gradient, drawn with its middle at `x`.
Picture Disc(int size, float x, float gain) {
  Picture picture{size, size, {}};
  for (int i = 0; i < size * size; ++i) {
    const float dx = float(i % size) - x, dy = float(i / size) - float(size) / 2;
    const float code = dx * dx + dy * dy < float(size * size) / 16 ? 200.f : float(i % size) * 0.5f;
    picture.codes.insert(picture.codes.end(), 3, std::min(255.f, gain * code));
  }
  return picture;
}

/// 0 where the comparison judges a known pair as it should.
int SelfTest(const std::string& pair) {
  const Picture baseline = Disc(100, 50, 1);
  Picture ignored;
  if (pair == "same") return Agree(Disc(100, 50, 1), baseline, &ignored) ? 0 : 1;
  if (pair == "shifted") return Agree(Disc(100, 56, 1), baseline, &ignored) ? 1 : 0;
  if (pair == "brighter") return Agree(Disc(100, 50, 1.05f), baseline, &ignored) ? 1 : 0;
  return Agree(Disc(90, 45, 1), baseline, &ignored) ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const double meanTolerance = argc == 4 ? std::atof(argv[3]) : kMeanTolerance;
  if (argc < 3 || argc > 4 || !(meanTolerance > 0)) {
    std::fprintf(stderr, "Usage: lambertCompareImages IMAGE BASELINE [CODES IN THE MEAN]\n");
    return 2;
  }
  if (std::string(argv[1]) == "--self-test") return SelfTest(argv[2]);
  Picture difference;
  if (Agree(Read(argv[1]), Read(argv[2]), &difference, meanTolerance)) return 0;
  if (!difference.codes.empty()) WriteDifference(difference, argv[1]);
  return 1;
}
