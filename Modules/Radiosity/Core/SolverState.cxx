#include "Radiosity/Core/SolverState.h"

#include <array>
#include <cstring>
#include <fstream>

#include "Common/Core/ContentHash.h"
#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"
#include "Scene/Core/SceneKey.h"

namespace lambert {

namespace {

/// What a file begins with.
constexpr std::array<char, 8> kMagic{'L', 'a', 'm', 'b', 'e', 'r', 't', 'S'};
/// Of the file and of all that elements and links follow from: another one is refused.
constexpr uint64_t kVersion = 2;
/// Bytes that are read, written and hashed together.
constexpr size_t kBlock = size_t(1) << 20;

/// The bytes of a file in blocks, and behind them the hash of all.
class StateWriter {
 public:
  explicit StateWriter(const std::string& fileName) : file_(fileName, std::ios::binary) {}

  template <class T>
  void operator()(const T& value) {
    this->Bytes(&value, sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(uint64_t(values.size()));
    this->Bytes(values.data(), values.size() * sizeof(T));
  }
  /// False where not all could be written.
  bool Finish() {
    this->Flush();
    file_.write(reinterpret_cast<const char*>(&hash_), sizeof hash_);
    file_.close();
    return bool(file_);
  }

 private:
  void Bytes(const void* data, size_t size) {
    for (size_t done = 0; done < size;) {
      const size_t part = std::min(size - done, kBlock - used_);
      std::memcpy(block_.data() + used_, static_cast<const char*>(data) + done, part);
      used_ += part, done += part;
      if (used_ == kBlock) this->Flush();
    }
  }
  void Flush() {
    hash_ = HashOfBytes(block_.data(), used_, hash_);
    file_.write(block_.data(), std::streamsize(used_));
    used_ = 0;
  }

  std::ofstream file_;
  std::vector<char> block_ = std::vector<char>(kBlock);
  size_t used_ = 0;
  uint64_t hash_ = 0;
};

/// Reads what a StateWriter wrote, from a file whose hash is right.
class StateReader {
 public:
  explicit StateReader(const std::string& fileName) : file_(fileName, std::ios::binary) {}

  template <class T>
  void operator()(T& value) {
    file_.read(reinterpret_cast<char*>(&value), sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    uint64_t count = 0;
    (*this)(count);
    values.resize(size_t(count));
    file_.read(reinterpret_cast<char*>(values.data()), std::streamsize(count * sizeof(T)));
  }

 private:
  std::ifstream file_;
};

/// What every file begins with: what it is, and what scene it belongs to.
struct Header {
  std::array<char, 8> magic = kMagic;
  uint64_t version = kVersion;
  uint64_t geometry = 0, cuts = 0, materials = 0, lights = 0;
  uint64_t firstElements = 0;  ///< that there are before any is split
};

Header HeaderFor(const ElementHierarchy& hierarchy, int64_t firstElements) {
  const SceneKey key = KeyOf(hierarchy.GetScene());
  Header header;
  header.geometry = HashOf(hierarchy.Tree().nodes, key.geometry);
  const LeafMeshOptions& patches = hierarchy.Leaves().Options();
  header.cuts = HashOf<float>({float(patches.refinement), patches.snapTolerance}, 0);
  header.materials = key.materials;
  header.lights = key.lights;
  header.firstElements = uint64_t(firstElements);
  return header;
}

/// The elements that splits made, by their parent; and those found to be at the floor.
struct Splits {
  std::vector<int32_t> parents, atFloor;
  int64_t children = 0;  ///< of all parents
};

Splits SplitsOf(const ElementHierarchy& hierarchy) {
  Splits splits;
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const Element& element = hierarchy[index];
    const bool isSplit = element.parent >= 0 && !hierarchy[element.parent].IsVolume();
    if (isSplit && hierarchy[element.parent].child == index) {
      splits.parents.push_back(element.parent);
      splits.children += hierarchy[element.parent].childCount;
    }
    if (element.IsPolygon() && element.IsLeaf() && !element.canSplit) {
      splits.atFloor.push_back(index);
    }
  }
  return splits;
}

/// Splits elements in the order in which they were split, in runs as long as parents ascend and
/// exist: children get their old numbers. False where one does not come to be.
bool SplitAgain(const Splits& splits, ElementHierarchy* hierarchy) {
  std::vector<int32_t> run;
  for (const int32_t parent : splits.parents) {
    if (!run.empty() && (parent <= run.back() || parent >= hierarchy->Size())) {
      hierarchy->Split(run);
      run.clear();
    }
    if (parent >= hierarchy->Size()) return false;
    run.push_back(parent);
  }
  hierarchy->Split(run);
  hierarchy->Split(splits.atFloor);
  return true;
}

/// What the file holds behind its header, written or read.
template <class Archive>
void Exchange(Archive& archive, Splits* splits, SolverState* state) {
  archive(splits->parents);
  archive(splits->atFloor);

  // Light.
  archive(state->light.radiosity);
  archive(state->light.variation);
  archive(state->light.irradiance);
  archive(state->light.rowScale);
  archive(state->exposures);
  archive(state->received);

  // Links, member by member: they have padding.
  std::vector<uint32_t> counts;
  for (const std::vector<Link>& links : state->network.incoming) {
    counts.push_back(uint32_t(links.size()));
  }
  archive(counts);
  state->network.incoming.resize(counts.size());
  for (size_t receiver = 0; receiver < counts.size(); ++receiver) {
    state->network.incoming[receiver].resize(counts[receiver]);
    for (Link& link : state->network.incoming[receiver]) {
      archive(link.source);
      archive(link.transfer);
      archive(link.visibility);
      archive(link.isSampled);
      archive(link.isCertain);
    }
  }
  archive(state->network.rays);
  archive(state->network.linksAtFloor);

  // The history.
  uint64_t iterations = state->history.size();
  archive(iterations);
  state->history.resize(size_t(iterations));
  for (IterationRecord& record : state->history) {
    archive(record.iteration);
    archive(record.seconds);
    archive(record.threshold);
    archive(record.elements);
    archive(record.links);
    archive(record.rays);
    archive(record.change);
    archive(record.error);
  }
}

/// The hash of the first `size` bytes of a file, as a StateWriter makes it.
uint64_t HashOfFile(std::ifstream* file, uint64_t size) {
  std::vector<char> block(kBlock);
  uint64_t hash = 0;
  for (uint64_t done = 0; done < size;) {
    const size_t part = size_t(std::min<uint64_t>(kBlock, size - done));
    file->read(block.data(), std::streamsize(part));
    hash = HashOfBytes(block.data(), part, hash);
    done += part;
  }
  return hash;
}

}  // namespace

void SaveSolverState(const SolverState& state, const std::string& fileName) {
  // A run that is cut short leaves the state before whole.
  WriteOutput(fileName, [&](const std::string& name) {
    StateWriter writer(name);
    Splits splits = SplitsOf(state.hierarchy);
    writer(HeaderFor(state.hierarchy, state.hierarchy.Size() - splits.children));
    SolverState written = state;
    Exchange(writer, &splits, &written);
    return writer.Finish();
  });
}

void RequireSolverState(const std::string& fileName) {
  std::ifstream file(fileName, std::ios::binary | std::ios::ate);
  if (!file) {
    throw Error("The state " + fileName + " cannot be read; give a file that a solver has saved.");
  }
  const auto size = uint64_t(file.tellg());
  file.seekg(0);
  Header header;
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!file || header.magic != kMagic) {
    throw Error("The file " + fileName + " is no state of a solver; give one that it has saved.");
  }
  if (header.version != kVersion) {
    throw Error("The state " + fileName + " was saved by another version of Lambert (format " +
                std::to_string(header.version) + ", this one has " + std::to_string(kVersion) +
                "); solve from the beginning.");
  }
  file.seekg(0);
  uint64_t expected = 0;
  const uint64_t hash = HashOfFile(&file, size - sizeof expected);
  file.read(reinterpret_cast<char*>(&expected), sizeof expected);
  if (!file || hash != expected) {
    throw Error("The state " + fileName + " was cut short or changed; solve from the beginning.");
  }
}

void LoadSolverState(const std::string& fileName, SolverState* state) {
  // Whose state it is.
  RequireSolverState(fileName);
  StateReader reader(fileName);
  Header header;
  reader(header);
  const Header own = HeaderFor(state->hierarchy, state->hierarchy.Size());
  const std::string other = header.geometry != own.geometry     ? "a scene with other geometry"
                            : header.materials != own.materials ? "a scene with other materials"
                            : header.lights != own.lights       ? "a scene with other lights"
                            : header.cuts != own.cuts ? "another refinement or snap tolerance"
                                                      : "";
  if (!other.empty()) {
    throw Error("The state " + fileName + " belongs to " + other +
                "; give the scene and the options that it was saved with, or solve from the "
                "beginning.");
  }

  // Its elements again, its links and light as they were.
  Splits splits;
  Exchange(reader, &splits, state);
  if (header.firstElements != own.firstElements || !SplitAgain(splits, &state->hierarchy) ||
      size_t(state->hierarchy.Size()) != state->light.radiosity.size()) {
    throw Error("The state " + fileName +
                " was saved by a version of Lambert that makes other elements; solve from the "
                "beginning.");
  }
}

}  // namespace lambert
