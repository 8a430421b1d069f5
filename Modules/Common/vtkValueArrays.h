// Data arrays of VTK and the vectors of the algorithms. C++ only.
#ifndef vtkValueArrays_h
#define vtkValueArrays_h

#include "Common/Core/Error.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace lambert {
/// Tuples of an array of any type as T, which is floats without gaps; empty where there is no
/// array. Throws Error for another number of components.
template <class T>
std::vector<T> TuplesFromArray(vtkDataArray* array, const char* name) {
  constexpr int kComponents = sizeof(T) / sizeof(float);
  std::vector<T> values;
  if (!array) {
    return values;
  }
  if (array->GetNumberOfComponents() != kComponents) {
    throw Error(std::string("The array ") + name + " has " +
                std::to_string(array->GetNumberOfComponents()) + " components; it needs " +
                std::to_string(kComponents) + ".");
  }
  values.resize(static_cast<size_t>(array->GetNumberOfTuples()));
  if (auto* floats = vtkFloatArray::FastDownCast(array); floats && !values.empty()) {
    std::memcpy(static_cast<void*>(values.data()), floats->GetPointer(0),
                values.size() * sizeof(T));
    return values;
  }
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    float* tuple = reinterpret_cast<float*>(&values[static_cast<size_t>(i)]);
    for (int c = 0; c < kComponents; ++c) {
      tuple[c] = static_cast<float>(array->GetComponent(i, c));
    }
  }
  return values;
}

template <class T>
vtkSmartPointer<vtkFloatArray> ArrayFromTuples(const char* name, const std::vector<T>& values) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(sizeof(T) / sizeof(float));
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  if (!values.empty()) {
    std::memcpy(array->GetPointer(0), values.data(), values.size() * sizeof(T));
  }
  return array;
}

/// An array that `data` of a `holder` ("mesh", "solution") must have, a tuple for each of `count`.
/// Throws Error where it has not, and says what `source` makes it.
inline vtkDataArray* RequireArray(vtkFieldData* data, const char* name, int components,
                                  size_t count, const std::string& holder,
                                  const std::string& source) {
  vtkDataArray* array = data->GetArray(name);
  if (!array || array->GetNumberOfComponents() != components ||
      array->GetNumberOfTuples() != static_cast<vtkIdType>(count)) {
    throw Error("The " + holder + " has no array " + name + " of " + std::to_string(components) +
                (components == 1 ? " component" : " components") + "; it takes " + source + ".");
  }
  return array;
}

/// Numbers of one component, whole ones exact below 2^53; empty where there is no array.
template <class T>
std::vector<T> NumbersFromArray(vtkDataArray* array) {
  std::vector<T> values(array ? static_cast<size_t>(array->GetNumberOfTuples()) : 0);
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<T>(array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  return values;
}

template <class Array, class T>
vtkSmartPointer<Array> ArrayFromNumbers(const char* name, const std::vector<T>& values) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}
}  // namespace lambert

#endif
