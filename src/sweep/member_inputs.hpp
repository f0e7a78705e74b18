#pragma once

#include <map>
#include <string>
#include <vector>

#include "case/document.hpp"
#include "sweep/study.hpp"

namespace railwave::sweep {

/// The case with a member's overrides; keys that it does not know are left to the reading of the case.
case_file::Node with_overrides(const case_file::Node& case_root, const std::vector<std::string>& overrides);

/// A hash of all that members' results depend on: the case with its overrides, the files that it names, the program's
/// version. Each file is read once.
class MemberHash {
 public:
  /// @param root of the case with the member's overrides
  /// @param files that it names
  std::string of(const case_file::Node& root, const std::vector<std::string>& files);

 private:
  const std::string& of_file(const std::string& path);
  std::map<std::string, std::string> files_;
};

/// Whether case and files on the disk are no longer those of which the study was read: a run would be another member's.
bool inputs_have_changed(const Study& study, const Member& member);

}  // namespace railwave::sweep
