#include "image/color_messages.h"

#include <OpenColorIO/OpenColorIO.h>

#include <utility>

namespace sateen {

void hear_color_messages(std::function<void(const std::string& message)> hear) {
  OCIO_NAMESPACE::SetLoggingFunction([hear = std::move(hear)](const char* text) {
    std::string message = text;
    // "[OpenColorIO Warning]: Unknown key ..."
    if (const size_t end = message.find("]: "); message.starts_with('[') && end != std::string::npos)
      message.erase(0, end + 3);
    while (message.ends_with('\n')) message.pop_back();
    if (!message.empty()) hear(message);
  });
}

}  // namespace sateen
