#pragma once

#include <sys/types.h>

namespace plash {

/// An X server without a screen (Xvfb) for as long as the object lives, so that OpenGL has somewhere to draw
/// on machines without a display. Where Xvfb is not installed but DISPLAY names a display, that one is used.
class VirtualDisplay {
public:
    /// Throws std::runtime_error with what to install when there is neither.
    VirtualDisplay();
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

private:
    pid_t server_ = -1;
};

} // namespace plash
