#include "parser/deck.h"

#include "parser/card.h"
#include "parser/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace plash {
namespace {

namespace fs = std::filesystem;

/// Includes inside includes: more is a circle that changes its names, or a mistake.
constexpr int deepest_include = 64;
/// Files that include each other several times would grow without end.
constexpr std::size_t most_files = 10'000;

std::string upper(std::string_view text)
{
    std::string result(text);
    for (char& character : result)
        if (character >= 'a' && character <= 'z') character -= 'a' - 'A';
    return result;
}

/// A keyword line, taken apart: name, what follows on the line, field width of its +, - or % suffix.
struct KeywordLine {
    std::string_view name;
    std::string_view rest;
    int minimum_width;
};

KeywordLine parse_keyword_line(std::string_view line, int minimum_width)
{
    line = trimmed(line.substr(1));
    const auto end = std::min(line.find_first_of(" \t,"), line.size());
    KeywordLine result{line.substr(0, end), trimmed(line.substr(end)), minimum_width};
    char sign = 0;
    if (result.name.size() > 1 &&
        std::string_view("+-%").find(result.name.back()) != std::string_view::npos) {
        sign = result.name.back();
        result.name.remove_suffix(1);
    } else if (result.rest == "+" || result.rest == "-" || result.rest == "%") {
        sign = result.rest.front();
    }
    if (sign) result.minimum_width = sign == '+' ? 20 : sign == '%' ? 10 : 0;
    return result;
}

/// `LONG=Y` and `I10=Y` of the *KEYWORD line.
int format_of_keyword_line(std::string_view rest)
{
    std::string text = upper(rest);
    std::erase(text, ' ');
    if (text.find("LONG=Y") != std::string::npos) return 20;
    if (text.find("I10=Y") != std::string::npos) return 10;
    return 0;
}

class Scanner {
public:
    Scanner(Deck& deck, Report& report) : deck_(deck), report_(report) {}

    void scan_deck(const std::string& path)
    {
        start_directory_ = fs::path(path).parent_path();
        scan_file(path, {}, 0, nullptr);
    }

private:
    /// State of the file that is being read.
    struct File {
        int index;
        fs::path directory;
        bool master;
        int minimum_width;
        const IncludeTransform* transform;
        bool ended = false;
    };

    void scan_file(const std::string& path, Location from, int minimum_width,
                   const IncludeTransform* transform)
    {
        std::unique_ptr<TextFile> text_file;
        try {
            text_file = std::make_unique<TextFile>(path);
        } catch (const FileError& error) {
            report_.error(from, from.file == none ? "" : "INCLUDE", from.file == none ? "" : "FILENAME",
                          error.what());
            return;
        }
        File file{static_cast<int>(deck_.files.size()), fs::path(path).parent_path(), from.file == none,
                  minimum_width, transform};
        const std::string_view text = text_file->text();
        deck_.names.push_back(path);
        deck_.files.push_back(std::move(text_file));
        deck_.bytes += text.size();

        std::error_code ignored;
        open_.push_back(fs::weakly_canonical(path, ignored).string());
        const TextFile& mapped = *deck_.files.back();
        scan_text(text, file);
        mapped.release(text);
        open_.pop_back();
    }

    void scan_text(std::string_view text, File& file)
    {
        LineCursor cursor(text, 1);
        std::string_view line;
        bool found = false, encrypted = false;
        Block block;
        const char* begin = text.data();
        while (!file.ended) {
            const char* line_begin = cursor.position();
            const bool more = cursor.next(line);
            if (more && line.starts_with("-----BEGIN PGP") && !encrypted) {
                encrypted = true;
                report_.error({file.index, cursor.line()}, upper(block.keyword.name), "",
                              "the data from here on are encrypted; only LS-DYNA itself can read them");
            }
            if (more && (line.empty() || line.front() != '*')) continue;
            if (found) {
                block.text = std::string_view(begin, line_begin - begin);
                block.lines = cursor.line() - block.where.line - (more ? 1 : 0);
                if (!encrypted) take(block, file);
            } else if (!trimmed(first_data_line({begin, static_cast<std::size_t>(line_begin - begin)}))
                            .empty()) {
                report_.warning({file.index, 1}, "", "", "text before the first keyword is not read");
            }
            if (!more || file.ended) break;
            found = true;
            encrypted = false;
            start_block(line, cursor.line(), file, block);
            begin = cursor.position();
        }
        if (!found && file.master)
            report_.error({file.index, 1}, "", "",
                          text.empty() ? "the file is empty"
                                       : "no keyword (a line starting with *) found: "
                                         "this is not a keyword deck");
    }

    static std::string_view first_data_line(std::string_view text)
    {
        LineCursor cursor(text, 1);
        std::string_view line;
        while (cursor.next_data(line))
            if (!trimmed(line).empty()) return line;
        return {};
    }

    void start_block(std::string_view line, int number, File& file, Block& block)
    {
        const KeywordLine keyword = parse_keyword_line(line, file.minimum_width);
        block = {};
        block.where = {file.index, number};
        block.minimum_width = keyword.minimum_width;
        block.transform = file.transform;
        if (upper(keyword.name) == "KEYWORD" && file.master) {
            file.minimum_width = format_of_keyword_line(keyword.rest);
            block.minimum_width = file.minimum_width;
        }
        block.keyword = layout_table().resolve(keyword.name);
    }

    /// Obeys the block, or keeps it.
    void take(const Block& block, File& file)
    {
        const std::string& name = block.keyword.name;
        if (name == "END") {
            file.ended = true;
        } else if (name == "KEYWORD" || name.starts_with("COMMENT")) {
            return;
        } else if (name == "TITLE") {
            deck_.title = trimmed(first_data_line(block.text));
        } else if (name == "PARAMETER_EXPRESSION" || name.starts_with("PARAMETER_EXPRESSION_")) {
            read_expressions(block, file);
        } else if (name == "PARAMETER_DUPLICATION") {
            std::int64_t flag = 0;
            const std::string_view line = first_data_line(block.text);
            if (parse_whole(line.substr(0, 10), flag))
                deck_.parameters.set_duplication(static_cast<int>(flag));
        } else if (name == "PARAMETER" ||
                   (name.starts_with("PARAMETER_") && block.keyword.layout && name != "PARAMETER_TYPE")) {
            read_parameters(block, file);
        } else if (name == "INCLUDE") {
            for (const auto& [path, line] : file_names(block))
                include(path, {file.index, line}, block, file, file.transform);
        } else if (name == "INCLUDE_TRANSFORM" || name.starts_with("INCLUDE_AUTO_OFFSET")) {
            include_with_transform(block, file);
        } else if (name == "INCLUDE_PATH" || name == "INCLUDE_PATH_RELATIVE") {
            for (const auto& [path, line] : file_names(block)) {
                const fs::path given = native(path);
                search_paths_.push_back(
                    name == "INCLUDE_PATH" || given.is_absolute() ? given : start_directory_ / given);
            }
        } else {
            deck_.blocks.push_back(block);
        }
    }

    /// Four pairs of name and value to a line.
    void read_parameters(const Block& block, const File& file)
    {
        std::vector<FieldLayout> fields(8);
        for (std::size_t i = 0; i < fields.size(); i += 2) {
            fields[i].name = "PRMR";
            fields[i].type = FieldType::text;
        }
        const int scope = block.keyword.name.find("LOCAL") != std::string::npos ? file.index : none;
        LineCursor cursor(block.text, block.where.line + 1);
        CardCutter cutter;
        std::string_view line;
        std::vector<std::string_view> tokens;
        while (cursor.next_data(line)) {
            const Location where{file.index, cursor.line()};
            cutter.cut(line, fields, block.minimum_width, tokens);
            for (std::size_t i = 0; i + 1 < tokens.size(); i += 2) {
                if (trimmed(tokens[i]).empty()) continue;
                if (trimmed(tokens[i + 1]).empty())
                    report_.error(where, "PARAMETER", trimmed(trimmed(tokens[i]).substr(1)),
                                  "the parameter has no value");
                else
                    deck_.parameters.define(tokens[i], tokens[i + 1], false, scope, file.index, where,
                                            report_);
            }
        }
    }

    /// Name in the first ten columns, expression behind; a line that leaves the name blank goes on with it.
    void read_expressions(const Block& block, const File& file)
    {
        const int scope = block.keyword.name.find("LOCAL") != std::string::npos ? file.index : none;
        const std::size_t width = std::max(10, block.minimum_width);
        LineCursor cursor(block.text, block.where.line + 1);
        std::string_view line;
        std::string name, expression;
        Location where;
        const auto finish = [&] {
            if (!name.empty())
                deck_.parameters.define(name, expression, true, scope, file.index, where, report_);
        };
        while (cursor.next_data(line)) {
            std::string_view first = line.substr(0, std::min(width, line.size()));
            std::string_view rest = line.size() > width ? line.substr(width) : std::string_view();
            if (const auto comma = first.find(','); comma != std::string_view::npos) {
                rest = line.substr(comma + 1);
                first = first.substr(0, comma);
            }
            if (trimmed(first).empty()) {
                expression += trimmed(rest);
                continue;
            }
            finish();
            name = trimmed(first);
            expression = trimmed(rest);
            where = {file.index, cursor.line()};
        }
        finish();
    }

    /// File names of a block with their lines; ` +` at the end of a line goes on with the next one.
    static std::vector<std::pair<std::string, int>> file_names(const Block& block)
    {
        std::vector<std::pair<std::string, int>> names;
        LineCursor cursor(block.text, block.where.line + 1);
        std::string_view line;
        bool goes_on = false;
        while (cursor.next_data(line)) {
            std::string_view part = trimmed(line);
            const bool more = part.size() > 1 && part.ends_with(" +");
            if (more) part = trimmed(part.substr(0, part.size() - 1));
            if (goes_on)
                names.back().first += part;
            else if (!part.empty())
                names.emplace_back(part, cursor.line());
            goes_on = more && !names.empty();
        }
        return names;
    }

    /// Windows separators as this system's.
    static fs::path native(std::string name)
    {
        std::replace(name.begin(), name.end(), '\\', '/');
        return name;
    }

    /// The only file of this name in the folders directly below; empty when there is none or a choice.
    static fs::path in_a_folder_below(const fs::path& directory, const fs::path& name)
    {
        fs::path found;
        std::error_code error;
        for (const fs::directory_entry& entry :
             fs::directory_iterator(directory.empty() ? "." : directory, error)) {
            if (!entry.is_directory(error)) continue;
            const fs::path candidate = entry.path() / name.filename();
            if (!fs::is_regular_file(candidate, error)) continue;
            if (!found.empty()) return {};
            found = candidate;
        }
        return found;
    }

    /// *INCLUDE_TRANSFORM and *INCLUDE_AUTO_OFFSET hold one file name and what is done to the file.
    void include_with_transform(const Block& block, const File& file)
    {
        const auto names = file_names(block);
        if (names.empty()) return;
        IncludeTransform transform = file.transform ? *file.transform : IncludeTransform{};
        if (block.keyword.name == "INCLUDE_TRANSFORM")
            read_include_transform(block, deck_.parameters, report_, transform);
        else
            read_auto_offset(block, deck_, report_, transform);
        deck_.transforms.push_back(std::make_unique<IncludeTransform>(std::move(transform)));
        include(names.front().first, {file.index, names.front().second}, block, file,
                deck_.transforms.back().get());
    }

    void include_file(const fs::path& path, const std::string& name, Location where, const Block& block,
                      const IncludeTransform* transform)
    {
        std::error_code ignored;
        const std::string canonical = fs::weakly_canonical(path, ignored).string();
        if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
            report_.error(where, "INCLUDE", "FILENAME", fmt::format("'{}' includes itself", name));
        } else if (fs::is_directory(path, ignored)) {
            report_.error(where, "INCLUDE", "FILENAME", fmt::format("'{}' is a directory, not a deck", name));
        } else if (open_.size() >= deepest_include) {
            report_.error(
                where, "INCLUDE", "FILENAME",
                fmt::format("'{}' would be include number {} inside one another", name, open_.size()));
        } else if (deck_.files.size() >= most_files) {
            report_.error(where, "INCLUDE", "FILENAME",
                          fmt::format("more than {} files are included", most_files));
        } else {
            scan_file(path.lexically_normal().string(), where, block.minimum_width, transform);
        }
    }

    void include(const std::string& name, Location where, const Block& block, const File& file,
                 const IncludeTransform* transform)
    {
        std::vector<fs::path> places{file.directory, start_directory_};
        places.insert(places.end(), search_paths_.begin(), search_paths_.end());
        for (const fs::path& given : {fs::path(name), native(name)}) {
            for (const fs::path& place : places) {
                const fs::path candidate = given.is_absolute() || place.empty() ? given : place / given;
                std::error_code ignored;
                if (fs::exists(candidate, ignored)) {
                    include_file(candidate, name, where, block, transform);
                    return;
                }
            }
        }
        if (const fs::path found = in_a_folder_below(file.directory, native(name)); !found.empty()) {
            report_.warning(
                where, "INCLUDE", "FILENAME",
                fmt::format("there is no file '{}' beside the deck: '{}' is taken", name, found.string()));
            include_file(found, name, where, block, transform);
            return;
        }
        report_.error(where, "INCLUDE", "FILENAME",
                      fmt::format("there is no file '{}' (looked beside the deck{})", name,
                                  search_paths_.empty() ? "" : " and in *INCLUDE_PATH"));
    }

    Deck& deck_;
    Report& report_;
    fs::path start_directory_;
    std::vector<fs::path> search_paths_;
    std::vector<std::string> open_; ///< canonical paths of the files being read, outermost first
};

} // namespace

Id Block::number(Kind kind, Id written) const
{
    if (!transform || written == 0) return written;
    return written > 0 ? written + transform->offset(kind) : written - transform->offset(kind);
}

bool Block::has(std::string_view option) const
{
    return std::find(keyword.options.begin(), keyword.options.end(), option) != keyword.options.end();
}

Deck scan_deck(const std::string& path, const std::vector<std::pair<std::string, std::string>>& overrides,
               Report& report)
{
    Deck deck;
    for (const auto& [name, value] : overrides) {
        if (!deck.parameters.set_override(name, value))
            report.error({}, "", "",
                         fmt::format("--set {}={}: a parameter needs a name and a value", name, value));
    }
    Scanner(deck, report).scan_deck(path);
    for (const std::string& name : deck.parameters.unused_overrides())
        report.error({}, "", "", fmt::format("--set {}: the deck defines no such parameter", name));
    return deck;
}

} // namespace plash
