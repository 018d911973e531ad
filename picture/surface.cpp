#include "picture/surface.h"

#include <stdexcept>

namespace plash {

namespace {

struct Named {
    Quantity quantity;
    const char* name;
    const char* title;
};

constexpr Named quantities[] = {
    {Quantity::von_mises, "von_mises", "von Mises stress"},
    {Quantity::plastic_strain, "plastic_strain", "effective plastic strain"},
    {Quantity::pressure, "pressure", "pressure"},
    {Quantity::velocity, "velocity", "velocity"},
    {Quantity::displacement, "displacement", "displacement"},
};

} // namespace

Quantity quantity_named(const std::string& name)
{
    std::string choices;
    for (const Named& entry : quantities) {
        if (name == entry.name) return entry.quantity;
        choices += std::string(choices.empty() ? "" : ", ") + entry.name;
    }
    throw std::runtime_error("unknown quantity '" + name + "'; known are " + choices);
}

std::string title_of(Quantity quantity)
{
    for (const Named& entry : quantities) {
        if (entry.quantity == quantity) return entry.title;
    }
    return {};
}

} // namespace plash
