#include "output/ascii_text.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

void append_scientific(std::string& text, double value, int width, int digits)
{
    const double size = std::abs(value);
    if (std::isfinite(value) && (size >= 1e100 || (size > 0 && size < 1e-99))) {
        std::string number = fmt::format("{:.{}E}", value, digits);
        number.erase(number.find('E'), 1);
        fmt::format_to(std::back_inserter(text), "{:>{}}", number, width);
    } else {
        fmt::format_to(std::back_inserter(text), "{:>{}.{}E}", value, width, digits);
    }
}

std::string_view plash_version()
{
    return PLASH_VERSION;
}

std::string ascii_heading(const Model& model)
{
    return fmt::format(" {:<72.72}\n{:25}plash {}\n", model.title, "", PLASH_VERSION);
}

std::string ascii_legend(std::string_view entries)
{
    return fmt::format("\n{{BEGIN LEGEND}}\n Entity #        Title\n{}{{END LEGEND}}\n\n", entries);
}

std::string legend_entry(Id id, std::string_view title, int title_width)
{
    return fmt::format("{:9}     {:<{}.{}}\n", id, title, title_width, title_width);
}

} // namespace plash
