#pragma once

#include "mesher/layers/front/layer_front.hpp"

namespace quadloop {

/// Checks that the layers of wakes and free lines touch neither themselves nor anything else, cover no body
/// and lie within the domain. Throws InputError with the name of the line, the place and a remedy.
void require_room_for_strips(const LayerFront& front);

}  // namespace quadloop
