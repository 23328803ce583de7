// Files that OBJ and MTL files name, as they lie on another disk than the one they were written on.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

struct FoundFile {
  std::filesystem::path path;  // where nothing was found: the name beside the first folder
  bool found;
  bool as_named;  // false where only a file of another case, or of the end of the name, was there
};

// Looks through folders, in their order.
class FileFinder {
 public:
  explicit FileFinder(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  // The file called `name` ("\" separates folders, too); else one whose name differs in case; else one called by the
  // end of the name, the longer the better ("C:\art\textures\Wood.PNG": textures/wood.png, else wood.png). Quotes about
  // the name are taken off where no file has them. Every name is looked for once.
  const FoundFile& find(std::string_view name);

 private:
  FoundFile look(std::string_view name) const;

  std::vector<std::filesystem::path> folders_;
  std::map<std::string, FoundFile, std::less<>> known_;
};

}  // namespace brume
