#pragma once

#include "core/term.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// The terms of all *CONTACT_... of a Model, in deck order. DeckError where a contact cannot work.
std::vector<std::unique_ptr<Term>> make_contacts(const Model& model);

} // namespace plash
