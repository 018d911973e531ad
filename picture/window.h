#pragma once

#include <string>
#include <vtkSmartPointer.h>

class vtkRenderWindow;
class vtkRenderer;

namespace plash {

/// A white renderer for a rectangle of the window, given in pixels from its lower left corner.
vtkSmartPointer<vtkRenderer> pane(vtkRenderWindow* window, int x, int y, int width, int height);

/// Writes what the window shows into a PNG file. Throws std::runtime_error when it cannot be written.
void save_window(vtkRenderWindow* window, const std::string& path);

} // namespace plash
