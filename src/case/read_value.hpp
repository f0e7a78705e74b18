#pragma once

#include <functional>
#include <optional>
#include <string>

#include "case/document.hpp"
#include "case/key.hpp"

namespace railwave::case_file {

/// What a key takes, for messages and pages: "a number in Pa", "a list of names", "'viscous' or 'stiffness'".
std::string expectation(const Key& key, bool with_unit = true);

/// The allowed numbers: "above 0", "between 0 and 2", "above -1 and below 0.5"; "" without a limit.
std::string range_text(const Range& range);

/// The default as it would be written in a case file; "" when there is none.
std::string default_text(const Key& key);

/// 'a', 'b' or 'c'.
std::string alternatives(const std::vector<std::string>& choices);

/// Says what is wrong, and where.
using Complain = std::function<void(Where, const std::string&)>;

/// The node as the key's kind of value; nothing when it is of another kind or out of range, which has been reported by
/// `complain`; what is odd, but taken, is reported by `remark`. Names are not looked up here.
std::optional<Value> read_value(const Key& key, const Node& node, const Complain& complain, const Complain& remark);

}  // namespace railwave::case_file
