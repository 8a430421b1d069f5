#include "ObjFile.h"

#include "Common/Core/OutputFile.h"
#include "PngImage.h"

#include <cstdio>
#include <filesystem>

namespace lambert {
namespace {
namespace fs = std::filesystem;

/// Numbers of a line with so many digits that they are read as the same floats.
template <class... Numbers>
void AppendLine(const char* word, std::string* text, Numbers... numbers) {
  *text += word;
  for (const double number : {static_cast<double>(numbers)...}) {
    char digits[32];
    std::snprintf(digits, sizeof digits, " %.9g", number);
    *text += digits;
  }
  *text += '\n';
}

std::string NameOfMaterial(size_t mesh) { return "light_" + std::to_string(mesh); }

/// A viewer shows colour and image as they are: without ambient light and shine.
std::string MaterialLibrary(const LitModel& model, const std::vector<std::string>& files) {
  std::string text = "# Light as colours: tone mapped, to be drawn without shading\n";
  for (size_t mesh = 0; mesh < model.meshes.size(); ++mesh) {
    text += "newmtl " + NameOfMaterial(mesh) + "\nillum 0\nKa 0 0 0\nKs 0 0 0\n";
    if (model.meshes[mesh].image >= 0) {
      const size_t image = static_cast<size_t>(model.meshes[mesh].image);
      text += "Kd 1 1 1\nmap_Kd " + fs::path(files[1 + image]).filename().string() + "\n";
    }
  }
  return text;
}

/// The mesh behind `points` points and `coords` texture coordinates.
void AppendMesh(const LitMesh& mesh, size_t number, size_t points, size_t coords,
                std::string* text) {
  *text += "g " + NameOfMaterial(number) + "\nusemtl " + NameOfMaterial(number) + "\n";

  // Points with their colours, white over an image: readers expect them of all points or of none.
  for (size_t p = 0; p < mesh.positions.size(); ++p) {
    const Vec3f& at = mesh.positions[p];
    const Spectrum color = mesh.colors.empty() ? Spectrum(1.f) : mesh.colors[p];
    AppendLine("v", text, at.x, at.y, at.z, SrgbFromLinear(color.r), SrgbFromLinear(color.g),
               SrgbFromLinear(color.b));
  }

  // Their places in the image.
  for (const Vec2f& uv : mesh.textureCoords) {
    AppendLine("vt", text, uv.x, uv.y);
  }

  // Triangles; numbers begin with 1.
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    *text += "f";
    for (const int32_t corner : triangle) {
      const size_t c = static_cast<size_t>(corner) + 1;
      *text += " " + std::to_string(points + c);
      if (!mesh.textureCoords.empty()) {
        *text += "/" + std::to_string(coords + c);
      }
    }
    *text += '\n';
  }
}
}  // namespace

std::vector<std::string> FilesBesideObj(const std::string& fileName, int images) {
  const fs::path folder = fs::path(fileName).parent_path();
  const std::string stem = fs::path(fileName).stem().string();
  std::vector<std::string> files = {(folder / (stem + ".mtl")).string()};
  for (int image = 0; image < images; ++image) {
    files.push_back((folder / (stem + "-" + std::to_string(image) + ".png")).string());
  }
  return files;
}

void WriteObj(const LitModel& model, const std::string& fileName) {
  // The faces. A name goes on to the end of its line, blanks and all.
  const std::vector<std::string> files =
      FilesBesideObj(fileName, static_cast<int>(model.images.size()));
  std::string text = "# Lambert: metres\nmtllib " + fs::path(files[0]).filename().string() + "\n";
  size_t points = 0, coords = 0;
  for (size_t mesh = 0; mesh < model.meshes.size(); ++mesh) {
    AppendMesh(model.meshes[mesh], mesh, points, coords, &text);
    points += model.meshes[mesh].positions.size();
    coords += model.meshes[mesh].textureCoords.size();
  }
  WriteOutput(fileName, text);

  // Their materials and images, beside them.
  WriteOutput(files[0], MaterialLibrary(model, files));
  for (size_t image = 0; image < model.images.size(); ++image) {
    WriteOutput(files[1 + image], PngOf(model.images[image]));
  }
}
}  // namespace lambert
