#include "materials/depth_stress.h"

#include "materials/parameters.h"
#include "model/eulerian.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

std::vector<Index> parts_of(const Model& model, const Record& record)
{
    if (record.keyword == "INITIAL_STRESS_DEPTH_SET") {
        for (const PartSet& set : model.part_sets) {
            if (set.id == record.integer("PSID")) return set.parts;
        }
        reject_field(record, "PSID", fmt::format("there is no part set {}", record.integer("PSID")));
    }
    for (std::size_t part = 0; part < model.parts.size(); ++part) {
        if (model.parts[part].id == record.integer("PID")) return {static_cast<Index>(part)};
    }
    reject_field(record, "PID", fmt::format("there is no part {}", record.integer("PID")));
}

bool holds(const std::vector<Index>& parts, Index part)
{
    return std::find(parts.begin(), parts.end(), part) != parts.end();
}

} // namespace

std::vector<DepthStress> depth_stresses(const Model& model)
{
    std::vector<DepthStress> stresses;
    for (const Record& record : model.others) {
        if (!record.keyword.starts_with("INITIAL_STRESS_DEPTH")) continue;
        for (const char* curve : {"LC", "LCH", "LCK0"}) {
            if (record.peek(curve) && record.integer(curve) != 0) {
                reject_field(record, curve, "stresses by a curve are not supported; give RO_G and KFACT");
            }
        }
        for (const Index part : parts_of(model, record)) {
            const bool solids = holds(model.solids.part, part) && !is_eulerian(model, part);
            if (!solids && !holds(model.particles.part, part)) {
                throw DeckError(record.where, fmt::format("*{}: part {} has neither Lagrangian solids nor "
                                                          "particles",
                                                          record.keyword, model.parts[part].id));
            }
            std::erase_if(stresses, [&](const DepthStress& one) { return one.part == part; });
            stresses.push_back(
                {part, record.where, record.real("RO_G"), record.real("ZDATUM"), record.real("KFACT")});
        }
    }
    return stresses;
}

} // namespace plash
