#pragma once

#include "mesher/base/ids.hpp"

namespace quadloop::test {

constexpr NodeId node(std::int32_t number) { return NodeId{number}; }

}  // namespace quadloop::test
