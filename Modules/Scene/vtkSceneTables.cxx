#include "vtkSceneTables.h"

#include "Common/Core/Error.h"
#include "Scene/Core/LightSource.h"
#include "Scene/Core/SceneLimits.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkRadiosityArrays.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

namespace lambert {
namespace {
using Names = vtkRadiosityArrays;

/// Writes columns of one table.
class TableWriter {
 public:
  TableWriter(vtkFieldData* fields, size_t rows)
      : Fields(fields), Rows(static_cast<vtkIdType>(rows)) {}

  /// `value(row, component)` gives the entries.
  template <class Array, class Value>
  void Numbers(const char* name, int components, const Value& value) {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(this->Rows);
    for (vtkIdType row = 0; row < this->Rows; ++row) {
      for (int c = 0; c < components; ++c) {
        array->SetComponent(row, c, static_cast<double>(value(static_cast<size_t>(row), c)));
      }
    }
    this->Fields->AddArray(array);
  }

  template <class Value>
  void Strings(const char* name, const Value& value) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->SetNumberOfValues(this->Rows);
    for (vtkIdType row = 0; row < this->Rows; ++row) {
      array->SetValue(row, value(static_cast<size_t>(row)));
    }
    this->Fields->AddArray(array);
  }

 private:
  vtkFieldData* Fields;
  vtkIdType Rows;
};

/// Reads columns of one table. Its first number column says how many rows there are; a column that
/// is missing leaves the defaults.
class TableReader {
 public:
  TableReader(vtkFieldData* fields, const char* firstColumn)
      : Fields(fields), FirstColumn(firstColumn) {
    vtkAbstractArray* array = fields->GetAbstractArray(firstColumn);
    this->NumberOfRows = array ? array->GetNumberOfTuples() : 0;
  }

  size_t Rows() const { return static_cast<size_t>(this->NumberOfRows); }

  /// Calls set(row, component, value) for every entry.
  template <class Set>
  void Numbers(const char* name, int components, const Set& set) const {
    vtkDataArray* array = this->Fields->GetArray(name);
    if (!array) {
      return;
    }
    this->CheckRows(name, array);
    if (array->GetNumberOfComponents() != components) {
      throw Error(std::string("The field array ") + name + " has " +
                  std::to_string(array->GetNumberOfComponents()) + " components; it needs " +
                  std::to_string(components) + ".");
    }
    for (vtkIdType row = 0; row < this->NumberOfRows; ++row) {
      for (int c = 0; c < components; ++c) {
        set(static_cast<size_t>(row), c, array->GetComponent(row, c));
      }
    }
  }

  template <class Set>
  void Strings(const char* name, const Set& set) const {
    auto* array = vtkStringArray::SafeDownCast(this->Fields->GetAbstractArray(name));
    if (!array) {
      return;
    }
    this->CheckRows(name, array);
    for (vtkIdType row = 0; row < this->NumberOfRows; ++row) {
      set(static_cast<size_t>(row), array->GetValue(row));
    }
  }

 private:
  void CheckRows(const char* name, vtkAbstractArray* array) const {
    if (array->GetNumberOfTuples() != this->NumberOfRows) {
      throw Error(std::string("The field array ") + name + " has " +
                  std::to_string(array->GetNumberOfTuples()) + " rows where " + this->FirstColumn +
                  " has " + std::to_string(this->NumberOfRows) + ".");
    }
  }

  vtkFieldData* Fields;
  std::string FirstColumn;
  vtkIdType NumberOfRows;
};

void ReadMaterials(vtkFieldData* fields, std::vector<Material>* materials) {
  const TableReader table(fields, Names::MaterialReflectance());
  materials->assign(table.Rows(), Material());
  std::vector<Material>& m = *materials;
  table.Strings(Names::MaterialName(),
                [&](size_t row, const std::string& name) { m[row].name = name; });
  table.Numbers(Names::MaterialReflectance(), 3, [&](size_t row, int c, double value) {
    m[row].reflectance[c] = static_cast<float>(value);
  });
  table.Numbers(Names::MaterialEmittance(), 3, [&](size_t row, int c, double value) {
    m[row].emittance[c] = static_cast<float>(value);
  });
  table.Numbers(Names::MaterialTwoSidedEmitter(), 1,
                [&](size_t row, int, double value) { m[row].twoSidedEmitter = value != 0; });
}

void WriteMaterials(const std::vector<Material>& m, vtkFieldData* fields) {
  TableWriter table(fields, m.size());
  table.Strings(Names::MaterialName(), [&](size_t row) { return m[row].name; });
  table.Numbers<vtkFloatArray>(Names::MaterialReflectance(), 3,
                               [&](size_t row, int c) { return m[row].reflectance[c]; });
  table.Numbers<vtkFloatArray>(Names::MaterialEmittance(), 3,
                               [&](size_t row, int c) { return m[row].emittance[c]; });
  table.Numbers<vtkUnsignedCharArray>(Names::MaterialTwoSidedEmitter(), 1,
                                      [&](size_t row, int) { return m[row].twoSidedEmitter; });
}

void ReadParts(vtkFieldData* fields, std::vector<Part>* parts) {
  const TableReader table(fields, Names::PartObjectToWorld());
  parts->assign(table.Rows(), Part());
  std::vector<Part>& p = *parts;
  table.Strings(Names::PartName(),
                [&](size_t row, const std::string& name) { p[row].name = name; });
  table.Strings(Names::PartSource(),
                [&](size_t row, const std::string& source) { p[row].source = source; });
  table.Numbers(Names::PartMeshId(), 1, [&](size_t row, int, double value) {
    p[row].meshId = static_cast<int32_t>(value);
  });
  table.Numbers(Names::PartObjectToWorld(), 16, [&](size_t row, int c, double value) {
    p[row].objectToWorld[static_cast<size_t>(c)] = value;
  });
}

void WriteParts(const std::vector<Part>& p, vtkFieldData* fields) {
  TableWriter table(fields, p.size());
  table.Strings(Names::PartName(), [&](size_t row) { return p[row].name; });
  table.Strings(Names::PartSource(), [&](size_t row) { return p[row].source; });
  table.Numbers<vtkIntArray>(Names::PartMeshId(), 1,
                             [&](size_t row, int) { return p[row].meshId; });
  table.Numbers<vtkDoubleArray>(Names::PartObjectToWorld(), 16, [&](size_t row, int c) {
    return p[row].objectToWorld[static_cast<size_t>(c)];
  });
}

void ReadLights(vtkFieldData* fields, std::vector<Light>* lights) {
  const TableReader table(fields, Names::LightType());
  lights->assign(table.Rows(), Light());
  std::vector<Light>& l = *lights;
  table.Strings(Names::LightName(),
                [&](size_t row, const std::string& name) { l[row].name = name; });
  table.Numbers(Names::LightType(), 1, [&](size_t row, int, double value) {
    if (!IsLightType(value)) {
      throw Error("The light " + std::to_string(row) + " is of no known type.");
    }
    l[row].type = static_cast<LightType>(static_cast<int>(value));
  });
  table.Numbers(Names::LightPosition(), 3, [&](size_t row, int c, double value) {
    l[row].position[c] = static_cast<float>(value);
  });
  table.Numbers(Names::LightDirection(), 3, [&](size_t row, int c, double value) {
    l[row].direction[c] = static_cast<float>(value);
  });
  table.Numbers(Names::LightIntensity(), 3, [&](size_t row, int c, double value) {
    l[row].intensity[c] = static_cast<float>(value);
  });
  table.Numbers(Names::LightHorizon(), 3, [&](size_t row, int c, double value) {
    l[row].horizon[c] = static_cast<float>(value);
  });
  table.Numbers(Names::LightGround(), 3, [&](size_t row, int c, double value) {
    l[row].ground[c] = static_cast<float>(value);
  });
  table.Strings(Names::LightImage(),
                [&](size_t row, const std::string& file) { l[row].imageFile = file; });
  table.Numbers(Names::LightRotation(), 1, [&](size_t row, int, double value) {
    l[row].rotation = static_cast<float>(value);
  });
  table.Numbers(Names::LightSize(), 1,
                [&](size_t row, int, double value) { l[row].size = static_cast<float>(value); });
  table.Numbers(Names::LightConeAngles(), 2, [&](size_t row, int c, double value) {
    (c == 0 ? l[row].innerConeAngle : l[row].outerConeAngle) = static_cast<float>(value);
  });
  RequireSolvableLights(l);
  for (Light& light : l) {
    light.direction = Normalize(light.direction);
  }
}

void WriteLights(const std::vector<Light>& l, vtkFieldData* fields) {
  TableWriter table(fields, l.size());
  table.Strings(Names::LightName(), [&](size_t row) { return l[row].name; });
  table.Numbers<vtkIntArray>(Names::LightType(), 1,
                             [&](size_t row, int) { return static_cast<int>(l[row].type); });
  table.Numbers<vtkFloatArray>(Names::LightPosition(), 3,
                               [&](size_t row, int c) { return l[row].position[c]; });
  table.Numbers<vtkFloatArray>(Names::LightDirection(), 3,
                               [&](size_t row, int c) { return l[row].direction[c]; });
  table.Numbers<vtkFloatArray>(Names::LightIntensity(), 3,
                               [&](size_t row, int c) { return l[row].intensity[c]; });
  table.Numbers<vtkFloatArray>(Names::LightHorizon(), 3,
                               [&](size_t row, int c) { return l[row].horizon[c]; });
  table.Numbers<vtkFloatArray>(Names::LightGround(), 3,
                               [&](size_t row, int c) { return l[row].ground[c]; });
  table.Strings(Names::LightImage(), [&](size_t row) { return l[row].imageFile; });
  table.Numbers<vtkFloatArray>(Names::LightRotation(), 1,
                               [&](size_t row, int) { return l[row].rotation; });
  table.Numbers<vtkFloatArray>(Names::LightSize(), 1, [&](size_t row, int) { return l[row].size; });
  table.Numbers<vtkFloatArray>(Names::LightConeAngles(), 2, [&](size_t row, int c) {
    return c == 0 ? l[row].innerConeAngle : l[row].outerConeAngle;
  });
}

void ReadCamera(vtkFieldData* fields, std::optional<Camera>* camera) {
  const TableReader table(fields, Names::CameraPosition());
  if (table.Rows() != 1) {
    camera->reset();
    return;
  }
  Camera& view = camera->emplace();
  table.Numbers(Names::CameraPosition(), 3,
                [&](size_t, int c, double value) { view.position[c] = value; });
  table.Numbers(Names::CameraFocalPoint(), 3,
                [&](size_t, int c, double value) { view.focalPoint[c] = value; });
  table.Numbers(Names::CameraViewUp(), 3,
                [&](size_t, int c, double value) { view.viewUp[c] = value; });
  table.Numbers(Names::CameraViewAngle(), 1,
                [&](size_t, int, double value) { view.verticalFieldOfView = value; });
}

void WriteCamera(const Camera& view, vtkFieldData* fields) {
  TableWriter table(fields, 1);
  table.Numbers<vtkDoubleArray>(Names::CameraPosition(), 3,
                                [&](size_t, int c) { return view.position[c]; });
  table.Numbers<vtkDoubleArray>(Names::CameraFocalPoint(), 3,
                                [&](size_t, int c) { return view.focalPoint[c]; });
  table.Numbers<vtkDoubleArray>(Names::CameraViewUp(), 3,
                                [&](size_t, int c) { return view.viewUp[c]; });
  table.Numbers<vtkDoubleArray>(Names::CameraViewAngle(), 1,
                                [&](size_t, int) { return view.verticalFieldOfView; });
}
}  // namespace

void ReadSceneTables(vtkFieldData* fields, Scene* scene) {
  ReadMaterials(fields, &scene->materials);
  ReadParts(fields, &scene->parts);
  ReadLights(fields, &scene->lights);
  ReadCamera(fields, &scene->camera);
}

void WriteSceneTables(const Scene& scene, vtkFieldData* fields) {
  WriteMaterials(scene.materials, fields);
  WriteParts(scene.parts, fields);
  if (!scene.lights.empty()) {
    WriteLights(scene.lights, fields);
  }
  if (scene.camera) {
    WriteCamera(*scene.camera, fields);
  }
}
}  // namespace lambert
