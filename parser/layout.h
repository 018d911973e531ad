#pragma once

#include "model/record.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace plash {

/// What an id in a deck is the number of. Where a layout says `curve`, a table or a function may stand too.
enum class Kind : std::uint8_t {
    none,
    node,
    shell,
    solid,
    beam,
    tshell,
    discrete,
    mass,
    inertia,
    seatbelt,
    part,
    rigid_body,
    section,
    material,
    thermal_material,
    eos,
    hourglass,
    curve,
    table,
    function,
    node_set,
    segment_set,
    part_set,
    shell_set,
    solid_set,
    beam_set,
    tshell_set,
    discrete_set,
    group_set,
    box_set,
    mode_set,
    coordinate,
    vector,
    orientation,
    box,
    transformation,
    friction,
    count
};

/// For messages: "node set", "curve, table or function" ...
std::string_view to_string(Kind kind);

enum class FieldType : std::uint8_t { real, integer, text };

/// One column of a card.
struct FieldLayout {
    std::string name; ///< manual name; empty for columns without meaning
    FieldType type = FieldType::real;
    Kind kind = Kind::none; ///< whose number it is
    bool defines = false;   ///< it is the number of the definition itself
    int width = 10;         ///< columns in the small format
    bool has_default = false;
    double default_value = 0;
    std::string default_text;
};

/// One line of a definition, or lines that repeat.
struct CardLayout {
    enum class Repeat {
        once,
        rows, ///< one row of a table per repetition of the card (or of `group`)
        list  ///< values (or tuples) packed `per_line` to a line: one row of a table each
    };
    Repeat repeat = Repeat::once;
    bool optional = false; ///< present when another data line follows
    std::string condition; ///< present when it holds ("ELFORM in 101..105"), "&": when the line starts so
    std::string count;     ///< of rows or list entries ("NPLANE*NTHICK"); empty: until the next keyword
    int per_line = 1;      ///< of `list`
    std::vector<FieldLayout> fields;
    std::vector<CardLayout> group; ///< cards that repeat, or depend on the condition, together
};

/// A suffix of the keyword that adds lines.
struct OptionLayout {
    std::string name;
    static constexpr int before_all = -1, behind_all = -2;
    int after = before_all; ///< card (from 0) behind which its lines stand
    std::vector<CardLayout> cards;
};

enum class Treatment : std::uint8_t {
    read,   ///< translated into the Model; physics does not use it (`reason` may say why)
    run,    ///< honoured
    ignored ///< harmless, see `reason`
};

/// What is known of one keyword, from the files in parser/layouts.
struct KeywordLayout {
    std::string name; ///< canonical, without options
    std::vector<std::string> aliases;
    std::vector<CardLayout> cards;
    std::vector<OptionLayout> options; ///< in the order of their lines
    Treatment treatment = Treatment::read;
    std::string reason;                                              ///< why it is ignored or refused
    bool all_honoured = false;                                       ///< `run: all`
    std::vector<std::string> honoured;                               ///< fields that physics uses
    std::vector<std::pair<std::string, std::string>> ignored_fields; ///< name, why it changes nothing

    bool honours(std::string_view field) const;
    const OptionLayout* option(std::string_view name) const;
    /// What this keyword defines the number of (a material, a section ...), or Kind::none.
    Kind defines() const;
};

/// A keyword as a deck writes it, taken apart.
struct KeywordName {
    const KeywordLayout* layout = nullptr; ///< nullptr: unknown
    std::string name;                      ///< canonical, or as written when unknown
    std::vector<std::string> options;      ///< suffixes that were split off: "TITLE", "ID", "MPP" ...
};

/// All keywords that Plash knows. A layout is read when somebody asks for it: a deck uses a few dozen of
/// 1,450, and all of them would take 9 MB.
class LayoutTable {
public:
    /// Texts of layouts (their grammar stands in docs/layouts.md), which must live as long as the table. A
    /// mistake in one throws std::runtime_error when its keyword is asked for.
    explicit LayoutTable(const std::vector<std::string_view>& texts);

    /// Finds the keyword of a name in any spelling: aliases, `-` for `_`, options in any order.
    KeywordName resolve(std::string_view written) const;
    const KeywordLayout* find(std::string_view name) const;
    /// The keyword that is most like a name that is none: at most two letters or a tenth of them differ, are
    /// missing or are too many; else empty.
    std::string_view closest(std::string_view name) const;
    /// Every keyword, in the order of the texts.
    std::vector<const KeywordLayout*> all() const;

private:
    /// Keywords that share a body of cards.
    struct Family {
        std::string_view text;                               ///< heads and body
        int line = 0;                                        ///< of its start in its file
        std::vector<std::unique_ptr<KeywordLayout>> members; ///< none until one of them is asked for
        bool reading = false;
    };
    struct Place {
        std::uint32_t family, member;
    };
    mutable std::mutex mutex_; ///< of the members of families
    mutable std::vector<Family> families_;
    std::unordered_map<std::string, Place> by_name_;

    const std::vector<std::unique_ptr<KeywordLayout>>& members_of(Family&) const;
    const KeywordLayout* find_locked(std::string_view name) const;
};

/// The table built from parser/layouts/*.txt.
const LayoutTable& layout_table();

} // namespace plash
