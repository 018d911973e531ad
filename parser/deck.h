#pragma once

#include "parser/include_transform.h"
#include "parser/layout.h"
#include "parser/parameters.h"
#include "parser/report.h"
#include "parser/text_file.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// One keyword with its data lines, as written.
struct Block {
    KeywordName keyword;
    Location where;                              ///< of the keyword line; data start on the next one
    std::string_view text;                       ///< all lines up to the next keyword, comments included
    int lines = 0;                               ///< number of lines in `text`
    int minimum_width = 0;                       ///< of a field: 0 small format, 10 I10, 20 long
    const IncludeTransform* transform = nullptr; ///< of the include that it stands in; nullptr: none

    bool has(std::string_view option) const;
    /// A number as the whole deck knows it.
    Id number(Kind kind, Id written) const;
};

/// A deck with all its includes, cut into keyword blocks in the order of reading.
struct Deck {
    std::vector<std::string> names; ///< of the files, as opened
    std::vector<std::unique_ptr<TextFile>> files;
    std::vector<Block> blocks; ///< without those that the scan itself obeys (includes, parameters, comments)
    struct Obeyed {
        long number = 0;
        Location first;
    };
    std::map<std::string, Obeyed> obeyed; ///< blocks that the scan obeys, by keyword
    std::vector<std::unique_ptr<IncludeTransform>> transforms;
    Parameters parameters;
    std::string title;
    std::size_t bytes = 0;
};

/// Reads the files, obeys *INCLUDE, *PARAMETER, *KEYWORD, *TITLE and *END, and cuts the rest into blocks.
Deck scan_deck(const std::string& path, const std::vector<std::pair<std::string, std::string>>& overrides,
               Report& report);

/// The same for a deck whose text stands in memory and outlives the Deck; includes are looked for beside
/// `path`.
Deck scan_deck_text(const std::string& path, std::string_view text,
                    const std::vector<std::pair<std::string, std::string>>& overrides, Report& report);

} // namespace plash
