#include "contact/contacts.h"

#include "contact/force_transducer.h"

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
    if (mesh.facets.empty()) fail("its surfaces have no segments");
    if (contact.soft != 0) return;
    for (const auto& facet : mesh.facets) {
        if (facet.stiffness > 0 || facet.part == none) continue;
        fail(fmt::format(
            "the material of part {} gives no bulk modulus for the contact stiffness; SOFT = 1 takes "
            "it from masses and step",
            model.parts[facet.part].id));
    }
}

} // namespace

std::vector<std::unique_ptr<Term>> make_contacts(const Model& model)
{
    std::vector<std::unique_ptr<Term>> terms;
    if (model.contacts.empty()) return terms;
    const std::vector<PartData> parts = part_data(model);
    std::vector<const SurfaceContact*> contacts;
    for (const Contact& contact : model.contacts) {
        if (contact.kind == Contact::Kind::interior) continue;
        if (contact.kind == Contact::Kind::transducer) {
            terms.push_back(nullptr); // made below, once all that it listens to are there
            continue;
        }
        auto term = std::make_unique<SurfaceContact>(contact, model, parts);
        check(*term, model);
        contacts.push_back(term.get());
        terms.push_back(std::move(term));
    }
    std::size_t place = 0;
    for (const Contact& contact : model.contacts) {
        if (contact.kind == Contact::Kind::interior) continue;
        auto& term = terms[place++];
        if (!term) term = std::make_unique<ForceTransducer>(contact, model, parts, contacts);
    }
    return terms;
}

} // namespace plash
