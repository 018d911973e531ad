#include "solver/fluids/fluid_choice.h"

#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

std::optional<FluidForm> form_named(std::string_view word)
{
    std::string name(word);
    for (char& letter : name)
        if (letter >= 'A' && letter <= 'Z') letter += 'a' - 'A';
    std::erase(name, ' ');
    for (const FluidForm form : {FluidForm::lagrange, FluidForm::sph, FluidForm::ale})
        if (name == to_string(form)) return form;
    return {};
}

double not_negative(const Record& record, std::string_view field)
{
    const double value = record.real(field);
    if (value < 0) reject_field(record, field, fmt::format("{:g} is negative", value));
    return value;
}

} // namespace

std::string_view to_string(FluidForm form)
{
    switch (form) {
    case FluidForm::lagrange:
        return "lagrange";
    case FluidForm::sph:
        return "sph";
    case FluidForm::ale:
        break;
    }
    return "ale";
}

FluidChoice fluid_choice_of(const Model& model, std::string_view asked)
{
    constexpr const char* forms = "there are ale, sph and lagrange";
    FluidChoice choice;
    if (!asked.empty()) {
        choice.form = form_named(asked);
        if (!choice.form)
            throw DeckError({}, fmt::format("--fluid: there is no form '{}'; {}", asked, forms));
    }
    const auto found = std::find_if(model.others.begin(), model.others.end(),
                                    [](const Record& record) { return record.keyword == "PLASH_FLUID"; });
    if (found == model.others.end()) return choice;
    const Record& record = *found;
    choice.where = record.where;
    if (const std::string_view word = record.text("FLUID"); !choice.form && !word.empty()) {
        choice.form = form_named(word);
        if (!choice.form)
            reject_field(record, "FLUID", fmt::format("there is no form '{}'; {}", word, forms));
    }
    choice.size = not_negative(record, "SIZE");
    choice.height = not_negative(record, "HEIGHT");
    if (const Id id = record.integer("BOXID"); id != 0) {
        for (const NamedBox& box : model.boxes)
            if (box.id == id) choice.region = box.box;
        if (!choice.region) reject_field(record, "BOXID", fmt::format("there is no box {}", id));
    }
    return choice;
}

} // namespace plash
