#include "sweep/member_inputs.hpp"

#include <fstream>
#include <iterator>

#include "case/error.hpp"
#include "output/hash.hpp"

namespace railwave::sweep {

using case_file::Complaints;
using case_file::Node;

Node with_overrides(const Node& case_root, const std::vector<std::string>& overrides) {
  Complaints none(""), remarks("");
  Node root = case_root;
  case_file::apply_overrides(overrides, root, none, remarks);
  return root;
}

std::string MemberHash::of(const Node& root, const std::vector<std::string>& files) {
  Hash hash;
  hash.add("Railwave sweep member 1");
  hash.add(RAILWAVE_VERSION);
  hash.add(case_file::whole_text(root));
  for (const std::string& file : files) hash.add(of_file(file));
  return hash.text();
}

const std::string& MemberHash::of_file(const std::string& path) {
  std::string& known = files_[path];
  if (known.empty()) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    Hash hash;
    hash.add_words(bytes.data(), bytes.size());
    known = hash.text();
  }
  return known;
}

bool inputs_have_changed(const Study& study, const Member& member) try {
  Complaints complaints(study.case_file);
  const auto document = case_file::parse_document(case_file::load_text(study.case_file), complaints);
  return !complaints.empty() ||
         MemberHash().of(with_overrides(document.root, member.overrides), member.files) != member.hash;
} catch (const InputError&) {
  return true;  // the case is not there, or cannot be read
}

}  // namespace railwave::sweep
