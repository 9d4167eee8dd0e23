#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Leaves out the lines of drawings and maps that join nothing, such as centre lines: open chains both ends
/// of which meet no other end. A chain stays, for join_chains() to refuse, if it may be part of an outline
/// with a gap: its ends are nearer to each other than half its length, or one of them is nearer to another
/// loose end than a hundredth of it; or if nothing but a generated far field would be left. Chains of files
/// that define a direction stay too. Warns with the number and the first sources.
void leave_out_strays(std::vector<Chain>& chains, const std::string& far_field,
                      std::vector<std::string>& warnings);

}  // namespace quadloop
