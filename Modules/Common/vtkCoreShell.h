// What every filter does about the algorithm of a Core that it stands for: options that stand
// there, progress, abort and errors in VTK's terms. C++ only.
#ifndef vtkCoreShell_h
#define vtkCoreShell_h

#include "Common/Core/Error.h"
#include "Common/Core/Progress.h"
#include "vtkAlgorithm.h"

#include <exception>

/// Ends a setter of a choice, 0 to `last`, where `value` is none of them, by the sentence
/// "`expected`, not N.".
#define lambertRequireChoiceMacro(value, last, expected)    \
  if (value < 0 || value > static_cast<int>(last)) {        \
    vtkErrorMacro(<< expected << ", not " << value << "."); \
    return;                                                 \
  }

/// Set##name and Get##name of `filter` for an option of its `Options`, where the default stands.
#define lambertOptionMacro(filter, name, type, member) \
  void filter::Set##name(type value) {                 \
    if (this->Options->member != value) {              \
      this->Options->member = value;                   \
      this->Modified();                                \
    }                                                  \
  }                                                    \
  type filter::Get##name() { return this->Options->member; }

/// The same for a choice of the enumeration `type`, 0 to `last` as an int; any other is refused by
/// the sentence "`expected`, not N.".
#define lambertChoiceMacro(filter, name, type, member, last, expected) \
  void filter::Set##name(int value) {                                  \
    lambertRequireChoiceMacro(value, last, expected);                  \
    if (this->Get##name() != value) {                                  \
      this->Options->member = static_cast<type>(value);                \
      this->Modified();                                                \
    }                                                                  \
  }                                                                    \
  int filter::Get##name() { return static_cast<int>(this->Options->member); }

namespace lambert {
/// Shows the progress of `filter`; false where it is to be aborted.
inline ProgressCallback ProgressOf(vtkAlgorithm* filter) {
  return [filter](double fraction, const char* stage) {
    filter->SetProgressText(stage);
    filter->UpdateProgress(fraction);
    return !filter->GetAbortExecute();
  };
}

/// What RequestData returns of `work`(progress). An abort is no error, and nothing is delivered.
template <class Work>
int RunCore(vtkAlgorithm* filter, const Work& work) {
  try {
    work(ProgressOf(filter));
    return 1;
  } catch (const Cancelled&) {
    return 1;
  } catch (const std::exception& error) {
    vtkErrorWithObjectMacro(filter, << error.what());
    return 0;
  }
}
}  // namespace lambert

#endif
