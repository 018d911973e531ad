#pragma once

#include "parser/layout.h"
#include "parser/units.h"

#include <vector>

namespace plash {

/// What *INCLUDE_TRANSFORM does to the numbers and places in a file: offsets add up from the outer include to
/// the inner one, geometry is moved by the inner one first.
struct IncludeTransform {
    Id node = 0, element = 0, part = 0, material = 0, set = 0, curve = 0, define = 0, other = 0;
    std::vector<std::pair<Id, Location>>
        transformations; ///< *DEFINE_TRANSFORMATION and who asks, innermost first

    UnitFactors units; ///< outer and inner factors multiply

    /// What is added to the number of a thing of this kind.
    Id offset(Kind kind) const;
};

struct Block;
struct Deck;
class Parameters;
class Report;

/// Adds what the cards of *INCLUDE_TRANSFORM say to the transform of the file that it stands in.
void read_include_transform(const Block& block, const Parameters& parameters, Report& report,
                            IncludeTransform& transform);

/// *INCLUDE_AUTO_OFFSET: nodes and elements get numbers above all those read so far; _USER: given offsets.
void read_auto_offset(const Block& block, const Deck& deck, Report& report, IncludeTransform& transform);

} // namespace plash
