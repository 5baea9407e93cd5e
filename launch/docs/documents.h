#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fastball::launch {

/// What to make again, and with how many throws.
struct DocumentOptions {
  std::filesystem::path tree;       ///< of the sources: README.md, docs/, lcmtypes/
  std::filesystem::path campaigns;  ///< for the campaigns' folders; what is there goes on
  int throws = 2000;                ///< of each strategy
  int study_throws = 100;           ///< of each case of a study
};

/// One part of the documents that is measured or made from the sources.
struct DocumentPart {
  std::string name;
  std::string what;  ///< for --help
  std::function<void(const DocumentOptions&)> make;
};

/// In the order in which they are made, the quick ones first. Each throws std::runtime_error where a document has not the
/// place for what is made, or a program fails.
const std::vector<DocumentPart>& documentParts();

}  // namespace fastball::launch
