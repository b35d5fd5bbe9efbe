#pragma once

namespace sateen {

extern const char* const page_style;   ///< CSS
extern const char* const page_script;  ///< JavaScript of the slider

}  // namespace sateen
