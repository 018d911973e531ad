#pragma once

#include "model/model.h"

#include <string_view>

/// Which parts of a Model are meshes that material flows through, and small look-ups for keywords that the
/// Model keeps as records.
namespace plash {

/// The part's solids are cells of an Eulerian mesh: *SECTION_SOLID ELFORM 5, 6, 7, 11 or 12, in both forms of
/// the card.
bool is_eulerian(const Model& model, Index part);

/// Some element of the Model is a cell of an Eulerian mesh.
bool has_eulerian_mesh(const Model& model);

/// Number of material groups that a deck gives its Eulerian meshes (*ALE_MULTI-MATERIAL_GROUP and its kin),
/// at least 1: without them cells hold the material of their part.
std::size_t multi_material_groups(const Model& model);

/// Position of the part with this number; `none`: there is no such.
Index find_part(const Model& model, Id id);

/// A part set by its number; nullptr: there is no such.
const PartSet* find_part_set(const Model& model, Id id);

/// Parts that a pair of fields names, as most ALE keywords do: type 0 a part set, 1 a part. DeckError when
/// there is no such.
std::vector<Index> parts_of_fields(const Model& model, const Record& record, std::string_view id_field,
                                   std::string_view type_field);

} // namespace plash
