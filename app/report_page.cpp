#include "app/report_page.h"

#include "app/report_assets.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace plash {

namespace {

std::string escaped(std::string_view text)
{
    std::string result;
    for (char c : text) {
        switch (c) {
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '&':
            result += "&amp;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string base64(std::string_view bytes)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            result += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
        }
    }
    return result;
}

/// JSON in which numbers that are not finite are gaps.
nlohmann::json numbers(const std::vector<double>& values)
{
    nlohmann::json array = nlohmann::json::array();
    for (double value : values) array.push_back(std::isfinite(value) ? nlohmann::json(value) : nullptr);
    return array;
}

std::string plots_json(const std::vector<ReportPlot>& plots)
{
    nlohmann::json all = nlohmann::json::array();
    for (const ReportPlot& plot : plots) {
        nlohmann::json curves = nlohmann::json::array(), data = nlohmann::json::array({numbers(plot.time)});
        for (const auto& curve : plot.curves) {
            curves.push_back(curve.name);
            data.push_back(numbers(curve.values));
        }
        all.push_back({{"title", plot.title}, {"note", plot.note}, {"curves", curves}, {"data", data}});
    }
    // A title from the deck must not be able to end the script.
    std::string text;
    for (char c : all.dump()) {
        if (c == '/' && text.ends_with('<')) text += '\\';
        text += c;
    }
    return text;
}

std::string table(const std::vector<std::vector<std::string>>& rows)
{
    std::string html = "<table>\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        html += "<tr>";
        for (const std::string& cell : rows[i]) {
            html += fmt::format("<{0}>{1}</{0}>", i == 0 ? "th" : "td", escaped(cell));
        }
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

constexpr std::string_view style = R"(
body { font: 15px/1.5 system-ui, sans-serif; color: #1d2530; background: #f4f6f8; margin: 0; }
main { max-width: 1080px; margin: 0 auto; padding: 24px; }
h1 { font-size: 26px; margin: 0 0 4px; } h2 { font-size: 18px; margin: 0 0 2px; }
section { background: #fff; border: 1px solid #dde3ea; border-radius: 8px; padding: 16px 20px; margin: 16px 0; }
p.note { color: #5c6b7c; margin: 0 0 8px; font-size: 13px; }
p.verdict { padding: 8px 12px; border-radius: 6px; background: #e5f4ea; } p.trouble { background: #fbe3df; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(240px, 1fr)); gap: 6px 24px; margin: 8px 0 0; }
dt { color: #5c6b7c; font-size: 12px; } dd { margin: 0; font-variant-numeric: tabular-nums; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 3px 10px; border-bottom: 1px solid #e8edf2; }
th:first-child, td:first-child { text-align: left; } th { color: #5c6b7c; font-weight: 600; font-size: 13px; }
img { max-width: 100%; border-radius: 4px; }
footer { color: #5c6b7c; font-size: 12px; }
)";

constexpr std::string_view script = R"(
const colours = ["#1f6fb4", "#d1542b", "#3a9a5b", "#8a5bb5", "#b8860b", "#2aa3a3", "#c2477f", "#55606d", "#7a9a1f"];
const short = v => v == null ? "--" : v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(4)
    : v.toPrecision(6);
const tick = v => v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? (+v.toPrecision(4)).toExponential() : String(+v.toPrecision(6));
for (const plot of plots) {
    const section = document.createElement("section"), title = document.createElement("h2"),
          note = document.createElement("p"), place = document.createElement("div");
    title.textContent = plot.title; note.textContent = plot.note; note.className = "note";
    section.append(title, note, place);
    document.getElementById("plots").append(section);
    const width = () => section.clientWidth - 44;
    const axis = { values: (u, ticks) => ticks.map(tick) };
    const chart = new uPlot({
        width: width(), height: 300, scales: { x: { time: false } },
        axes: [{ ...axis, label: "time" }, { ...axis, size: 80 }], cursor: { drag: { x: true, y: true } },
        series: [{ label: "time", value: (u, v) => short(v) }].concat(plot.curves.map((name, i) => (
            { label: name, stroke: colours[i % colours.length], width: 1.6, value: (u, v) => short(v) })))
    }, plot.data, place);
    addEventListener("resize", () => chart.setSize({ width: width(), height: 300 }));
}
)";

} // namespace

std::string to_html(const ReportPage& page)
{
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                    "<title>{}</title>\n<style>{}{}</style>\n</head><body><main>\n<h1>{}</h1>\n",
                    escaped(page.title), uplot_style, style, escaped(page.title));
    html +=
        fmt::format("<p class=\"verdict{}\">{}</p>\n", page.trouble ? " trouble" : "", escaped(page.verdict));
    html += "<section><h2>The run</h2><dl>\n";
    for (const auto& [name, value] : page.facts) {
        html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
    }
    html += "</dl></section>\n";
    if (!page.picture_png.empty()) {
        html += fmt::format(
            "<section><h2>{0}</h2><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"></section>\n",
            escaped(page.picture_title), base64(page.picture_png));
    }
    html += "<div id=\"plots\"></div>\n";
    if (page.timings.size() > 1) {
        html +=
            "<section><h2>" + escaped(page.timings_title) + "</h2>\n" + table(page.timings) + "</section>\n";
    }
    html += fmt::format(
        "<footer>Drag over a plot to zoom, double click to zoom out, click a name to hide its curve. "
        "Plots by uPlot:<pre>{}</pre></footer>\n</main>\n<script>{}</script>\n"
        "<script>const plots = {};\n{}</script>\n</body></html>\n",
        escaped(uplot_licence), uplot_script, plots_json(page.plots), script);
    return html;
}

} // namespace plash
