#pragma once

#include <string_view>

/// What third_party/uplot holds, carried inside the program (written at build time by
/// app/embed_assets.cmake).
namespace plash {

extern const std::string_view uplot_script;
extern const std::string_view uplot_style;
extern const std::string_view uplot_licence;

} // namespace plash
