#pragma once

namespace sateen {

/// What a texture shows beside the unit square.
enum class TextureWrap { repeat, clamp, mirror };

}  // namespace sateen
