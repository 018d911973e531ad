// libFuzzer target of the reader: any text must become a Model and a list of messages, within bounds of time
// and memory, without a fault that the sanitizers see. How to run it stands in docs/results/reading.md.

#include "parser/read_model.h"

#include <cstddef>
#include <cstdint>

namespace {

/// The Model promises positions that exist; a reader that breaks the promise is found here and not in a
/// solver.
void visit(const plash::Model& model)
{
    const auto check = [](plash::Index index, std::size_t count) {
        if (index < plash::none || (index != plash::none && static_cast<std::size_t>(index) >= count))
            __builtin_trap();
    };
    plash::for_each_topology(model, [&](const auto& elements) {
        if (elements.id.size() != elements.part.size() || elements.id.size() != elements.nodes.size())
            __builtin_trap();
        for (std::size_t i = 0; i < elements.size(); ++i) {
            check(elements.part[i], model.parts.size());
            for (const plash::Index node : elements.nodes[i]) check(node, model.nodes.size());
        }
    });
    for (const plash::NodeSet& set : model.node_sets)
        for (const plash::Index node : set.nodes) check(node, model.nodes.size());
    for (const plash::PartSet& set : model.part_sets)
        for (const plash::Index part : set.parts) check(part, model.parts.size());
    for (const plash::ElementSet& set : model.shell_sets)
        for (const plash::Index element : set.elements) check(element, model.shells.size());
    for (const plash::ElementSet& set : model.solid_sets)
        for (const plash::Index element : set.elements) check(element, model.solids.size());
    for (const plash::ElementSet& set : model.beam_sets)
        for (const plash::Index element : set.elements) check(element, model.beams.size());
    for (const plash::Part& part : model.parts) {
        check(part.section, model.sections.size());
        check(part.material, model.materials.size());
        check(part.equation_of_state, model.equations_of_state.size());
        check(part.hourglass, model.hourglass.size());
    }
    for (const plash::FixedNodes& fixed : model.fixed_nodes)
        for (const plash::Index node : fixed.nodes) check(node, model.nodes.size());
    for (const plash::NodalLoad& load : model.nodal_loads) check(load.curve, model.curves.size());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    plash::ReadResult result = plash::read_model_text("fuzz.k", text);
    plash::list_unread_fields(result.model, result.report);
    for (const plash::Message& message : result.report.errors) plash::to_text(message, result.model);
    for (const plash::Message& message : plash::unsupported_keywords(result.report))
        plash::to_text(message, result.model);
    visit(result.model);
    return 0;
}
