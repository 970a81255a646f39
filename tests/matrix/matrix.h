#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/executor.h"

namespace firstray::matrix {

/// A line of the table: one property, how hard it was tried to break it, and what came of that.
struct Row {
    std::string id;  ///< "T1" to "T20"; several rows may share one
    std::string tried;
    std::uint64_t n = 0;  ///< rays, or whatever `tried` counts
    std::string result, target;
    bool met = true;
    std::string known_miss;  ///< why a target that is not met does not fail the run; empty: it does
};

/// What rows are measured with, and where they are put down.
class Matrix {
public:
    /// part      of the full numbers of rays and scenes, in (0, 1]
    /// programs  the folder of the build
    Matrix(double part, const Executor& executor, std::filesystem::path programs)
        : part_(part), executor_(executor), programs_(std::move(programs))
    {
    }

    /// The part of a full number that is asked for.
    std::uint64_t part_of(std::uint64_t full, std::uint64_t least = 1) const
    {
        return std::max(least, static_cast<std::uint64_t>(part_ * static_cast<double>(full)));
    }
    double part() const { return part_; }
    const Executor& executor() const { return executor_; }
    const std::filesystem::path& programs() const { return programs_; }

    /// Puts a row down and prints it to standard error: measuring takes minutes.
    void add(Row row);
    const std::vector<Row>& rows() const { return rows_; }

private:
    double part_;
    const Executor& executor_;
    std::filesystem::path programs_;
    std::vector<Row> rows_;
};

/// The rows as a table for people, or for README.
std::string table_of(const std::vector<Row>& rows);

// What measures rows, a function per file.
void watertight_rows(Matrix& matrix);   // T1
void distance_rows(Matrix& matrix);     // error of t by distance from the origin, beside Embree
void agreement_rows(Matrix& matrix);    // T2
void special_ray_rows(Matrix& matrix);  // T4
void scaling_rows(Matrix& matrix);      // T5
void garbage_rows(Matrix& matrix);      // T6
void duplicate_rows(Matrix& matrix);    // T7
void drift_rows(Matrix& matrix);        // T8
void spawned_rows(Matrix& matrix);      // T10
void extreme_rows(Matrix& matrix);      // T11
void mutant_rows(Matrix& matrix);       // T13
void determinism_rows(Matrix& matrix);  // T15
void compare_rows(Matrix& matrix);      // T18, T20
void cost_rows(Matrix& matrix);         // T19
void tested_rows(Matrix& matrix);       // what test cases of tests/ show, run at length: T3, T9, T12, ...

}  // namespace firstray::matrix
