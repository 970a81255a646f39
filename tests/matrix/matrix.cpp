#include "tests/matrix/matrix.h"

#include <cstdio>

namespace firstray::matrix {
namespace {

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t n)
{
    std::string digits = std::to_string(n);
    for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3)
        digits.insert(static_cast<std::size_t>(i), ",");
    return digits;
}

std::string verdict(const Row& row)
{
    if (row.target == "reported") return "";
    if (row.met) return "yes";
    return row.known_miss.empty() ? "**no**" : "no: " + row.known_miss;
}

std::string line_of(const Row& row)
{
    return "| " + row.id + " | " + row.tried + " | " + grouped(row.n) + " | " + row.result + " | " + row.target +
           " | " + verdict(row) + " |\n";
}

/// T2 comes before T10.
int number_of(const Row& row)
{
    return row.id.size() > 1 ? std::atoi(row.id.c_str() + 1) : 0;
}

}  // namespace

void Matrix::add(Row row)
{
    std::fputs(line_of(row).c_str(), stderr);
    rows_.push_back(std::move(row));
}

std::string table_of(const std::vector<Row>& rows)
{
    std::vector<Row> sorted = rows;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Row& a, const Row& b) { return number_of(a) < number_of(b); });
    std::string table = "| | tried | N | result | target | met |\n|---|---|---|---|---|---|\n";
    for (const Row& row : sorted) table += line_of(row);
    return table;
}

}  // namespace firstray::matrix
