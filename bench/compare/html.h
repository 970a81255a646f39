#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace firstray::compare {

/// Text as it stands in HTML and SVG, inside elements and quoted attributes.
std::string escaped(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// A paragraph of text, escaped.
std::string paragraph(std::string_view text, std::string_view type = "note");

/// A picture inside the page.
/// png  the file's bytes
std::string inline_png(std::string_view png, std::string_view alternative);

/// A table that scrolls sideways where the screen is narrow. The first column is a heading; all text is escaped.
class HtmlTable {
public:
    /// headings  "|" in one starts a new line
    explicit HtmlTable(std::vector<std::string> headings) : headings_(std::move(headings)) {}
    /// cells   the last one takes the columns that are left, as text
    /// marked  shows the row as one to beware of
    void add(std::vector<std::string> cells, bool marked = false);
    bool empty() const { return rows_.empty(); }
    std::string html() const;

private:
    struct Row {
        std::vector<std::string> cells;
        bool marked;
    };
    std::vector<std::string> headings_;
    std::vector<Row> rows_;
};

}  // namespace firstray::compare
