// Collections of pieces as files: NAME.vtpc, which names them, and the folder NAME beside it that
// they lie in. Written whole or not at all, as every output is.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lambert {

/// True for names that end in .vtpc, in any case.
bool IsCollectionFileName(const std::string& fileName);

/// The folder of the pieces of NAME.vtpc: NAME beside it. Bytes of the name that are no text stand
/// there as %FF.
std::string FolderOfPieces(const std::string& fileName);

/// True for what a collection of this name may write and remove: NAME/NAME-<write>-<piece>.vtp,
/// finished or not.
bool IsPieceOf(const std::string& fileName, const std::string& file);

/// Throws Error, one sentence, where the collection or its folder cannot be written. Leaves what
/// stands there as it is.
void RequireWritableCollection(const std::string& fileName);

/// Writes a collection of pieces of these names by `write`, which gets the number of a piece and
/// the file to write, and throws Error where it cannot. A piece without a name has none in the
/// collection either. Pieces take names that no earlier collection has, and the collection, which
/// is written last, those in: until then what stood there is whole. Afterwards the earlier pieces
/// are removed, and nothing else in the folder. Throws Error where not all arrives; what stood
/// there before is left then.
void WriteCollection(const std::string& fileName, const std::vector<std::string>& names,
                     const std::function<void(size_t piece, const std::string& file)>& write);

}  // namespace lambert
