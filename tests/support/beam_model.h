#pragma once

#include "model/model.h"
#include "tests/support/shell_model.h"

namespace plash {

/// A Model with one beam part (index 0): `count` elements in a row from the origin along x, third nodes at z.
/// section  fields of *SECTION_BEAM
inline Model beam_model(Record material, std::vector<std::pair<const char*, double>> section, double length,
                        int count)
{
    Model model;
    model.materials.push_back(std::move(material));
    model.sections.push_back(make_record("SECTION_BEAM", std::move(section)));
    Part part;
    part.id = 1;
    part.title = "beam";
    part.section = 0;
    part.material = 0;
    model.parts.push_back(part);
    model.controls.time.step_scale = 0.9;
    for (int i = 0; i <= count; ++i) add_node(model, {length * i / count, 0, 0});
    const Index third = add_node(model, {0, 0, length});
    for (int i = 0; i < count; ++i) {
        model.beams.id.push_back(i + 1);
        model.beams.part.push_back(0);
        model.beams.nodes.push_back({i, i + 1, third});
    }
    return model;
}

inline void add_curve(Model& model, std::vector<double> abscissa, std::vector<double> ordinate)
{
    NamedCurve curve;
    curve.id = static_cast<Id>(model.curves.size()) + 1;
    curve.curve = {std::move(abscissa), std::move(ordinate)};
    model.curves.push_back(std::move(curve));
}

} // namespace plash
