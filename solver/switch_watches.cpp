#include "solver/switch_watches.h"

#include "contact/rigid_wall.h"
#include "contact/surface_contact.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// The term whose deck object has this id, or else stands in this place in the deck, counted from 1.
template <class Wanted, class Object>
const Wanted* term_of(const std::vector<std::unique_ptr<Term>>& terms, const std::vector<Object>& objects,
                      const Object& (Wanted::*object_of)() const, Id number)
{
    const Object* wanted = nullptr;
    for (const Object& object : objects)
        if (object.id == number) wanted = &object;
    if (!wanted && number >= 1 && number <= static_cast<Id>(objects.size())) wanted = &objects[number - 1];
    for (const auto& term : terms) {
        const auto* found = dynamic_cast<const Wanted*>(term.get());
        if (found && &(found->*object_of)() == wanted) return found;
    }
    return nullptr;
}

} // namespace

void watch_forces(PartSwitches& switches, const Model& model, const std::vector<std::unique_ptr<Term>>& terms)
{
    using Code = PartSwitch::Code;
    for (PartSwitch& one : switches.all()) {
        if (one.code == Code::time) continue;
        if (one.code == Code::wall_free || one.code == Code::wall_pressed) {
            const auto* wall = term_of(terms, model.rigid_walls, &RigidWallTerm::wall, one.watched);
            if (wall) one.pressed = [wall] { return norm(wall->force()) > 0; };
        } else {
            const auto* contact = term_of(terms, model.contacts, &SurfaceContact::contact, one.watched);
            if (contact) one.pressed = [contact] { return contact->presses(); };
        }
        if (!one.pressed) {
            throw DeckError(one.where, fmt::format("*DEFORMABLE_TO_RIGID_AUTOMATIC, field ENTNO: {} is no "
                                                   "rigid wall or contact of surfaces as CODE {} wants it",
                                                   one.watched, static_cast<int>(one.code)));
        }
    }
}

} // namespace plash
