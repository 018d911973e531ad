#pragma once

#include "model/model.h"
#include "parser/report.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plash {

struct ReadOptions {
    /// --set NAME=VALUE: values that replace those of *PARAMETER.
    std::vector<std::pair<std::string, std::string>> parameters;
};

/// A deck as the program knows it.
struct ReadResult {
    Model model;
    Report report;         ///< errors and warnings, what became of each keyword, ignored fields
    bool ok = false;       ///< no errors: the Model may be used
    std::size_t bytes = 0; ///< size of the deck with its includes
};

/// Reads a keyword deck with its includes. Never throws for a fault of the deck: all of them are in the
/// report. Values of property records (sections, materials ...) that are still unread are not yet listed as
/// ignored: call list_unread_fields() after the physics has been set up from the Model.
ReadResult read_model(const std::string& path, const ReadOptions& options = {});

/// The same for a deck whose text stands in memory; `path` is its name in messages and where its includes are
/// looked for.
ReadResult read_model_text(const std::string& path, std::string_view text, const ReadOptions& options = {});

/// Completes the report: every non-default value of the Model's property records that nobody has read is
/// listed as ignored.
void list_unread_fields(const Model& model, Report& report);

/// Keywords that act on the physics and are not run (read, unsupported or unknown) as errors "file:line
/// *KEYWORD ...".
std::vector<Message> unsupported_keywords(const Report& report);

/// "deck.k:12: *SECTION_SHELL, field NIP: text"
std::string to_text(const Message& message, const Model& model);

} // namespace plash
