#include "parser/deck.h"

#include "parser/card.h"
#include "parser/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
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

    /// `text`: what the file holds, when it need not be opened.
    void scan_deck(const std::string& path, const std::optional<std::string_view>& text)
    {
        start_directory_ = fs::path(path).parent_path();
        const auto open = [&] {
            return text ? std::make_unique<TextFile>(path, *text) : std::make_unique<TextFile>(path);
        };
        scan_file(open, path, {}, 0, nullptr);
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

    template <class Open>
    void scan_file(Open&& open, const std::string& path, Location from, int minimum_width,
                   const IncludeTransform* transform)
    {
        std::unique_ptr<TextFile> text_file;
        try {
            text_file = open();
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

    /// Lines up to the next keyword.
    struct Extent {
        const char* end;                 ///< where that keyword stands
        long line_ends = 0;              ///< in between
        const char* encrypted = nullptr; ///< the first line of encrypted data, if any
    };

    /// `begin` is where a line begins. Works in windows that fit a cache, so that memory is read once.
    static Extent extent_from(const char* begin, const char* end, TextRelease& release)
    {
        constexpr std::ptrdiff_t window = 1 << 18;
        constexpr std::string_view encrypted = "-----BEGIN PGP";
        Extent extent{begin};
        for (const char* at = begin; at < end; at = extent.end) {
            const char* const stop = end - at > window ? at + window : end;
            const char* const keyword = find_line({at, static_cast<std::size_t>(stop - at)}, "*", begin);
            extent.end = keyword ? keyword : stop;
            extent.line_ends += count_lines({at, static_cast<std::size_t>(extent.end - at)});
            // The word may lie across two windows.
            const char* const from =
                std::max(begin, at - std::min<std::ptrdiff_t>(at - begin, encrypted.size()));
            if (!extent.encrypted)
                extent.encrypted =
                    find_line({from, static_cast<std::size_t>(extent.end - from)}, encrypted, begin);
            release.up_to(at);
            if (keyword) break;
        }
        return extent;
    }

    /// `begin` is the start of line `first_line`.
    void report_encrypted(const char* begin, const char* encrypted, int first_line, std::string_view keyword,
                          const File& file)
    {
        const long above = count_lines({begin, static_cast<std::size_t>(encrypted - begin)});
        report_.error({file.index, first_line + static_cast<int>(above)}, upper(keyword), "",
                      "the data from here on are encrypted; only LS-DYNA itself can read them");
    }

    /// From one keyword to the next.
    void scan_text(std::string_view text, File& file)
    {
        const char* const end = text.data() + text.size();
        TextRelease release(*deck_.files[file.index], text);
        const Extent before = extent_from(text.data(), end, release);
        const bool found = before.end != end;
        if (found &&
            !trimmed(first_data_line({text.data(), static_cast<std::size_t>(before.end - text.data())}))
                 .empty())
            report_.warning({file.index, 1}, "", "", "text before the first keyword is not read");
        if (!found && file.master)
            report_.error({file.index, 1}, "", "",
                          text.empty() ? "the file is empty"
                                       : "no keyword (a line starting with *) found: "
                                         "this is not a keyword deck");
        if (before.encrypted) report_encrypted(text.data(), before.encrypted, 1, "", file);
        int line = 1 + static_cast<int>(before.line_ends);
        Block block;
        for (const char* at = before.end; at != end && !file.ended;) {
            LineCursor cursor({at, static_cast<std::size_t>(end - at)}, line);
            std::string_view keyword;
            cursor.next(keyword);
            start_block(keyword, line, file, block);
            const char* const begin = cursor.position();
            const Extent extent = extent_from(begin, end, release);
            block.text = std::string_view(begin, extent.end - begin);
            block.lines =
                static_cast<int>(extent.line_ends + (!block.text.empty() && block.text.back() != '\n'));
            if (extent.encrypted) {
                report_encrypted(begin, extent.encrypted, line + 1, block.keyword.name, file);
            } else {
                take(block, file);
            }
            at = extent.end;
            line += 1 + static_cast<int>(extent.line_ends);
        }
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
        if (!obey(block, file)) {
            deck_.blocks.push_back(block);
            return;
        }
        Deck::Obeyed& obeyed = deck_.obeyed[block.keyword.name];
        if (obeyed.number++ == 0) obeyed.first = block.where;
    }

    /// False when the block is none of those that the scan obeys.
    bool obey(const Block& block, File& file)
    {
        const std::string& name = block.keyword.name;
        if (name == "END") {
            file.ended = true;
        } else if (name == "KEYWORD" || name.starts_with("COMMENT")) {
            return true;
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
                include(with_parameters(path, file), {file.index, line}, block, file, file.transform);
        } else if (name == "INCLUDE_TRANSFORM" || name.starts_with("INCLUDE_AUTO_OFFSET")) {
            include_with_transform(block, file);
        } else if (name == "INCLUDE_PATH" || name == "INCLUDE_PATH_RELATIVE") {
            for (const auto& [path, line] : file_names(block)) {
                const fs::path given = native(path);
                search_paths_.push_back(
                    name == "INCLUDE_PATH" || given.is_absolute() ? given : start_directory_ / given);
            }
        } else {
            return false;
        }
        return true;
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

    /// A file name with the values of the parameters in it: `bird_&MESH.k`. A name goes as far as letters,
    /// digits and underscores do; what is no parameter stays as it is, for `&` may stand in file names.
    std::string with_parameters(const std::string& name, const File& file) const
    {
        std::string result;
        for (std::size_t i = 0; i < name.size();) {
            std::size_t end = i + 1;
            if (name[i] == '&') {
                while (end < name.size() &&
                       (std::isalnum(static_cast<unsigned char>(name[end])) || name[end] == '_'))
                    ++end;
                const Substitution value =
                    deck_.parameters.substitute(std::string_view(name).substr(i, end - i), file.index);
                result += value.error.empty() ? std::string(trimmed(value.text)) : name.substr(i, end - i);
            } else {
                result += name[i];
            }
            i = end;
        }
        return result;
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
        include(with_parameters(names.front().first, file), {file.index, names.front().second}, block, file,
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
        } else if (!fs::is_regular_file(path, ignored)) { // a pipe or a device may keep us waiting for ever
            report_.error(where, "INCLUDE", "FILENAME", fmt::format("'{}' is not a regular file", name));
        } else if (open_.size() >= deepest_include) {
            report_.error(
                where, "INCLUDE", "FILENAME",
                fmt::format("'{}' would be include number {} inside one another", name, open_.size()));
        } else if (deck_.files.size() >= most_files) {
            report_.error(where, "INCLUDE", "FILENAME",
                          fmt::format("more than {} files are included", most_files));
        } else {
            const std::string file = path.lexically_normal().string();
            scan_file([&] { return std::make_unique<TextFile>(file); }, file, where, block.minimum_width,
                      transform);
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
        if (const fs::path found =
                fs::path(name).is_absolute() ? fs::path() : in_a_folder_below(file.directory, native(name));
            !found.empty()) {
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

namespace {

Deck scan(const std::string& path, const std::optional<std::string_view>& text,
          const std::vector<std::pair<std::string, std::string>>& overrides, Report& report)
{
    Deck deck;
    for (const auto& [name, value] : overrides) {
        if (!deck.parameters.set_override(name, value))
            report.error({}, "", "",
                         fmt::format("--set {}={}: a parameter needs a name and a value", name, value));
    }
    Scanner(deck, report).scan_deck(path, text);
    for (const std::string& name : deck.parameters.unused_overrides())
        report.error({}, "", "", fmt::format("--set {}: the deck defines no such parameter", name));
    return deck;
}

} // namespace

Deck scan_deck(const std::string& path, const std::vector<std::pair<std::string, std::string>>& overrides,
               Report& report)
{
    return scan(path, std::nullopt, overrides, report);
}

Deck scan_deck_text(const std::string& path, std::string_view text,
                    const std::vector<std::pair<std::string, std::string>>& overrides, Report& report)
{
    return scan(path, text, overrides, report);
}

} // namespace plash
