#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "post/channel_name.hpp"

using namespace railwave;

namespace {

/// A run with a force, a torque and two prescribed motions, of which one is called like the begin of the other.
ChannelNames names() {
  ChannelNames names;
  names.energies = {"kinetic"};
  names.loads = {"drive", "pull"};
  names.prescribed_motions = {"axle", "axle.left"};
  return names;
}

ChannelPlace place_of(const std::string& text) {
  const auto found = find_channels(text, names(), "results.h5");
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].size() == 1);
  CHECK(found[0][0].name() == text);
  return found[0][0];
}

}  // namespace

TEST_CASE("what loads and prescribed motions do are channels") {
  const ChannelPlace reaction = place_of("prescribed_motion.axle.left.reaction.z");
  CHECK(reaction.group == "prescribed_motion");
  CHECK(reaction.owner == "axle.left");
  CHECK(reaction.quantity == "reaction");
  CHECK(reaction.vector);
  CHECK(reaction.unit() == "N");
  const ChannelPlace work = place_of("prescribed_motion.axle.work");
  CHECK(work.owner == "axle");
  CHECK_FALSE(work.vector);
  CHECK(work.unit() == "J");
  CHECK(place_of("load.pull.force.x").vector);
  CHECK(place_of("load.drive.moment").unit() == "N m");
  CHECK(place_of("load.drive.work").unit() == "J");
}

TEST_CASE("a channel that a prescribed motion has not is refused with those that it has") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THROWS_WITH(find_channels("prescribed_motion.axle.reactoin.z", names(), "results.h5"),
                    ContainsSubstring("a prescribed_motion has no 'reactoin'; did you mean 'reaction'"));
  CHECK_THROWS_WITH(find_channels("prescribed_motion.axel.work", names(), "results.h5"),
                    ContainsSubstring("did you mean 'axle'"));
  CHECK_THROWS_WITH(find_channels("prescribed_motion.axle.reaction", names(), "results.h5"),
                    ContainsSubstring("it needs a direction at its end"));
}
