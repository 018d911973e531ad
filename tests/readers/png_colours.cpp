#include "tests/readers/png_colours.h"

#include <algorithm>
#include <array>
#include <set>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

namespace plash::testing {

PngFacts facts_of_png(const std::string& path)
{
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    PngFacts facts;
    facts.width = image->GetDimensions()[0];
    facts.height = image->GetDimensions()[1];
    std::set<std::array<unsigned char, 3>> colours;
    long coloured = 0;
    for (int y = 0; y < facts.height; ++y) {
        for (int x = 0; x < facts.width; ++x) {
            const auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
            colours.insert({pixel[0], pixel[1], pixel[2]});
            const auto [low, high] = std::minmax({pixel[0], pixel[1], pixel[2]});
            coloured += high - low > 40;
        }
    }
    facts.colours = static_cast<int>(colours.size());
    facts.coloured_share = static_cast<double>(coloured) / (static_cast<double>(facts.width) * facts.height);
    return facts;
}

} // namespace plash::testing
