#include "contact/contacts.h"

#include "contact/edge_contact.h"
#include "contact/force_transducer.h"
#include "contact/interior_contact.h"
#include "contact/tied_nodes.h"
#include "contact/tied_springs.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

/// A contact that has nothing to touch is a mistake of the deck, and so is one without stiffness.
void check(const SurfaceContact& term, const Model& model)
{
    const Contact& contact = term.contact();
    const ContactMesh& mesh = term.mesh();
    const auto fail = [&](const std::string& text) {
        throw DeckError(contact.where, fmt::format("*{} {}: {}", contact.keyword, contact.id, text));
    };
    if (mesh.facets.empty()) {
        fail(model.particles.size() == 0 ? "its surfaces have no segments"
                                         : "its surfaces have no segments; particles have none, and belong "
                                           "into SURFA of a contact of nodes");
    }
    if (contact.soft != 0) return;
    for (const auto& facet : mesh.facets) {
        if (facet.stiffness > 0 || facet.part == none) continue;
        fail(fmt::format(
            "the material of part {} gives no bulk modulus for the contact stiffness; SOFT = 1 takes "
            "it from masses and step",
            model.parts[facet.part].id));
    }
}

/// Springs of a tied contact; of one that is made by constraints only those that hold rigid nodes, which a
/// constraint cannot move. Nothing if there are none.
std::unique_ptr<Term> make_tied(const Contact& contact, const Model& model,
                                const std::vector<PartData>& parts)
{
    SurfaceOptions options;
    options.with_beams = true;
    const Surface slave = make_surface(model, parts, contact.slave, options);
    const Surface master = make_surface(model, parts, contact.master, options);
    TieSearch search = find_tied_points(slave, master, contact, model.nodes.position);
    std::vector<std::string> notices;
    if (ties_by_constraint(contact)) {
        std::erase_if(search.points, [&](const TiedPoint& point) {
            const Index part = slave.nodes[point.slave].part;
            return part == none || !parts[part].rigid;
        });
        if (search.points.empty()) return nullptr;
        notices.push_back(
            fmt::format("contact {}: springs tie {} nodes of rigid parts, which a constraint cannot move",
                        contact.id, search.points.size()));
    } else if (!search.left_out.empty()) {
        notices.push_back(fmt::format("contact {}: {} of {} nodes are not tied, as they lie over no segment "
                                      "or too far from it, first node {}",
                                      contact.id, search.left_out.size(), slave.nodes.size(),
                                      model.nodes.id[search.left_out.front()]));
    }
    TiedSprings springs(contact, model, slave, master, std::move(search.points));
    return std::make_unique<TiedContact>(contact, std::move(springs), std::move(notices));
}

} // namespace

std::vector<std::unique_ptr<Term>> make_contacts(const Model& model)
{
    std::vector<std::unique_ptr<Term>> terms;
    const auto is_interior = [](const Record& record) { return record.keyword == "CONTACT_INTERIOR"; };
    if (model.contacts.empty() && std::none_of(model.others.begin(), model.others.end(), is_interior))
        return terms;
    const std::vector<PartData> parts = part_data(model);
    std::vector<const SurfaceContact*> contacts;
    std::vector<std::pair<std::size_t, const Contact*>>
        transducers; // made once all that they listen to are there
    for (const Contact& contact : model.contacts) {
        switch (contact.kind) {
        case Contact::Kind::interior:
            break;
        case Contact::Kind::transducer:
            transducers.emplace_back(terms.size(), &contact);
            terms.push_back(nullptr);
            break;
        case Contact::Kind::tied:
            if (auto tied = make_tied(contact, model, parts)) terms.push_back(std::move(tied));
            break;
        default: {
            auto term = std::make_unique<SurfaceContact>(contact, model, parts);
            const bool general = contact.kind == Contact::Kind::general; // may have beams alone
            const bool segments = !general || !term->mesh().facets.empty();
            if (segments) {
                check(*term, model);
                contacts.push_back(term.get());
                terms.push_back(std::move(term));
            }
            if (!contact.edges) break;
            auto edges = std::make_unique<EdgeContact>(contact, model, parts);
            if (edges->edges().empty() && !segments) {
                throw DeckError(contact.where,
                                fmt::format("*{} {}: its parts have neither segments nor edges",
                                            contact.keyword, contact.id));
            }
            if (!edges->edges().empty()) terms.push_back(std::move(edges));
        }
        }
    }
    for (const Record& record : model.others) {
        const Table* sets = is_interior(record) ? record.table("PSID") : nullptr;
        for (std::size_t row = 0; sets && row < sets->rows(); ++row) {
            const Id id = static_cast<Id>(sets->at(row, 0));
            for (const PartSet& set : model.part_sets) {
                if (set.id == id) terms.push_back(std::make_unique<InteriorContact>(model, parts, set, 0.1));
            }
        }
    }
    for (const auto& [place, contact] : transducers) {
        terms[place] = std::make_unique<ForceTransducer>(*contact, model, parts, contacts);
    }
    return terms;
}

} // namespace plash
