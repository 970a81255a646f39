#include "bench/compare/html.h"

#include <cstdint>

namespace firstray::compare {

std::string escaped(std::string_view text)
{
    std::string result;
    result.reserve(text.size());
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string base64(std::string_view bytes)
{
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[three >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string paragraph(std::string_view text, std::string_view type)
{
    return "<p class=\"" + escaped(type) + "\">" + escaped(text) + "</p>\n";
}

std::string inline_png(std::string_view png, std::string_view alternative)
{
    return "<img alt=\"" + escaped(alternative) + "\" src=\"data:image/png;base64," + base64(png) + "\">";
}

void HtmlTable::add(std::vector<std::string> cells, bool marked)
{
    rows_.push_back({std::move(cells), marked});
}

std::string HtmlTable::html() const
{
    std::string text = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string& heading : headings_) {
        std::string lines = escaped(heading);
        if (const std::size_t bar = lines.find('|'); bar != std::string::npos) lines.replace(bar, 1, "<br>");
        text += "<th scope=\"col\">" + lines + "</th>";
    }
    text += "</tr></thead><tbody>\n";
    for (const Row& row : rows_) {
        text += row.marked ? "<tr class=\"marked\">" : "<tr>";
        for (std::size_t c = 0; c < row.cells.size(); ++c) {
            const char* tag = c == 0 ? "th" : "td";
            text += std::string("<") + tag + (c == 0 ? " scope=\"row\"" : "");
            if (c + 1 == row.cells.size() && row.cells.size() < headings_.size())
                text += " class=\"text\" colspan=\"" + std::to_string(headings_.size() - c) + "\"";
            text += ">" + escaped(row.cells[c]) + "</" + tag + ">";
        }
        text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
}

}  // namespace firstray::compare
