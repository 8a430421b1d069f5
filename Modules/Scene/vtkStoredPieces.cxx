#include "vtkStoredPieces.h"

#include "Common/Core/CollectionFile.h"
#include "Common/Core/Error.h"
#include "Common/Core/FileEnding.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPolyData.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUtilities.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <vtksys/SystemTools.hxx>

namespace lambert {
namespace {
namespace fs = std::filesystem;

/// Hears what VTK's reader would print.
class ErrorListener : public vtkCommand {
 public:
  static ErrorListener* New() { return new ErrorListener; }
  void Execute(vtkObject*, unsigned long, void*) override { this->Heard = true; }
  bool Heard = false;
};

/// Hears what the objects that a reader makes for itself would print.
class ErrorWindow : public vtkOutputWindow {
 public:
  static ErrorWindow* New() { VTK_STANDARD_NEW_BODY(ErrorWindow); }
  void DisplayErrorText(const char*) override { this->Heard = true; }
  void DisplayText(const char*) override {}
  bool Heard = false;
};

/// While it lives, VTK tells of its errors: it does so only while warnings are displayed.
class ErrorsTold {
 public:
  explicit ErrorsTold(vtkOutputWindow* window) {
    vtkObject::GlobalWarningDisplayOn();
    vtkOutputWindow::SetInstance(window);
  }
  ~ErrorsTold() {
    vtkOutputWindow::SetInstance(this->WindowBefore);
    vtkObject::SetGlobalWarningDisplay(this->DisplayBefore);
  }
  ErrorsTold(const ErrorsTold&) = delete;
  ErrorsTold& operator=(const ErrorsTold&) = delete;

 private:
  vtkSmartPointer<vtkOutputWindow> WindowBefore = vtkOutputWindow::GetInstance();
  int DisplayBefore = vtkObject::GetGlobalWarningDisplay();
};

/// VTK's reader crashes on arrays of a type that it does not know.
bool HasKnownTypes(const std::string& file) {
  static const std::set<std::string> known{"Int8",    "Int16",   "Int32",  "Int64",
                                           "UInt8",   "UInt16",  "UInt32", "UInt64",
                                           "Float32", "Float64", "String", "Bit"};
  // Tags, each with what stands before it; appended data are not read.
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  while (std::getline(stream, text, '>') && text.find("<AppendedData") == text.npos) {
    const size_t begin = text.rfind('<');
    if (begin == text.npos) {
      continue;
    }
    const std::string tag = text.substr(begin);
    if (tag.rfind("<DataArray", 0) != 0 && tag.rfind("<Array", 0) != 0) {
      continue;
    }
    const size_t type = tag.find(" type=");
    if (type == std::string::npos || type + 8 > tag.size()) {
      return false;
    }
    const size_t first = type + 7;  // Behind the quotation mark, of either kind.
    if (known.count(tag.substr(first, tag.find(tag[first - 1], first) - first)) == 0) {
      return false;
    }
  }
  return true;
}

bool IsVtp(const std::string& file) { return FileEnding(file) == ".vtp"; }

void RequireReadable(const std::string& file) {
  if (!vtksys::SystemTools::TestFileAccess(file, vtksys::TEST_FILE_READ | vtksys::TEST_FILE_OK)) {
    throw Error("The file '" + file + "' cannot be opened.");
  }
}

/// Null where the file is damaged.
vtkSmartPointer<vtkPolyData> ReadVtp(const std::string& file) {
  vtkNew<ErrorWindow> window;
  const ErrorsTold told(window);
  vtkNew<ErrorListener> listener;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetReaderErrorObserver(listener);
  reader->SetParserErrorObserver(listener);
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->SetFileName(file.c_str());
  const bool readable = reader->CanReadFile(file.c_str()) != 0 && HasKnownTypes(file);
  if (readable) {
    reader->Update();
  }
  if (!readable || listener->Heard || window->Heard || reader->GetErrorCode() != 0) {
    return nullptr;
  }
  return reader->GetOutput();
}

/// What the file tells of its pieces; null where it is damaged or something else.
vtkSmartPointer<vtkXMLDataElement> ReadCollection(const std::string& file) {
  constexpr const char* kType = "vtkPartitionedDataSetCollection";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    return nullptr;
  }
  vtkNew<ErrorWindow> window;
  const ErrorsTold told(window);
  auto root = vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  const char* type = root ? root->GetAttribute("type") : nullptr;
  if (!type || std::strcmp(type, kType) != 0 || window->Heard) {
    return nullptr;
  }
  return root->FindNestedElementWithName(kType);
}

/// A piece that the collection names, as far as its name tells what it is.
void RequirePolyData(const StoredPiece& piece) {
  const std::string which = "The file '" + piece.collection + "' names the piece '" + piece.file;
  if (!IsVtp(piece.file)) {
    throw Error(which + "', which is no poly data; turn it into a VTP file.");
  }
  std::error_code ignored;
  if (!fs::is_regular_file(piece.file, ignored)) {
    throw Error(which + "', which is not there; keep a collection and its folder side by side.");
  }
}
}  // namespace

bool IsStoredScene(const std::string& file) { return IsVtp(file) || IsCollectionFileName(file); }

std::vector<StoredPiece> FindStoredPieces(const std::string& file) {
  RequireReadable(file);
  if (IsVtp(file)) {
    return {{file, "", ""}};
  }
  const std::string damaged = "The file '" + file + "' is not a VTPC file or is damaged.";
  const vtkSmartPointer<vtkXMLDataElement> collection = ReadCollection(file);
  if (!collection) {
    throw Error(damaged);
  }
  std::vector<StoredPiece> pieces;
  for (int set = 0; set < collection->GetNumberOfNestedElements(); ++set) {
    vtkXMLDataElement* partitions = collection->GetNestedElement(set);
    if (std::strcmp(partitions->GetName(), "Partitions") != 0) {
      continue;  // How newer versions of VTK group them.
    }
    const char* name = partitions->GetAttribute("name");
    for (int i = 0; i < partitions->GetNumberOfNestedElements(); ++i) {
      const char* place = partitions->GetNestedElement(i)->GetAttribute("file");
      if (!place) {
        throw Error(damaged);
      }
      pieces.push_back({(fs::path(file).parent_path() / place).string(), name ? name : "", file});
      RequirePolyData(pieces.back());
    }
  }
  return pieces;
}

vtkSmartPointer<vtkPolyData> ReadStoredPiece(const StoredPiece& piece) {
  RequireReadable(piece.file);
  vtkSmartPointer<vtkPolyData> stored = ReadVtp(piece.file);
  if (!stored) {
    throw Error("The file '" + piece.file + "' is not a VTP file or is damaged" +
                (piece.collection.empty() ? "."
                                          : "; it is a piece of '" + piece.collection +
                                                "', which has to be written anew."));
  }
  return stored;
}
}  // namespace lambert
