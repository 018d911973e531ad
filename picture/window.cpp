#include "picture/window.h"

#include <cstdio>
#include <stdexcept>

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

namespace plash {

vtkSmartPointer<vtkRenderer> pane(vtkRenderWindow* window, int x, int y, int width, int height)
{
    const double w = window->GetSize()[0], h = window->GetSize()[1];
    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetViewport(x / w, y / h, (x + width) / w, (y + height) / h);
    renderer->SetBackground(1, 1, 1);
    window->AddRenderer(renderer);
    return renderer;
}

void save_window(vtkRenderWindow* window, const std::string& path)
{
    if (std::FILE* file = std::fopen(path.c_str(), "wb")) {
        std::fclose(file);
    } else {
        throw std::runtime_error("cannot be written: " + path);
    }
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window);
    image->ReadFrontBufferOff();
    image->Update();
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputConnection(image->GetOutputPort());
    writer->Write();
    if (writer->GetErrorCode() != 0) throw std::runtime_error("cannot be written: " + path);
}

} // namespace plash
