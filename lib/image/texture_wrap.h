#pragma once

namespace sateen {

/// What a texture shows beside the unit square; the last, nothing, is not a look's to ask for.
enum class TextureWrap { repeat, clamp, mirror, zero };

}  // namespace sateen
