#include "sil/metrics/assignment.hpp"

#include <algorithm>
#include <limits>

namespace semtrack::sil {

namespace {

/// Minimal cost over an n x n square; index 0 of all arrays is the root of the augmenting paths.
class Hungarian {
public:
    Hungarian(const std::vector<double>& values, std::size_t rows, std::size_t columns)
        : values_(values), rows_(rows), columns_(columns), n_(std::max(rows, columns)) {
        row_potential_.assign(n_ + 1U, 0.0);
        column_potential_.assign(n_ + 1U, 0.0);
        row_of_.assign(n_ + 1U, 0U);
    }

    std::vector<std::size_t> solve() {
        for (std::size_t row = 1; row <= n_; ++row) {
            insert(row);
        }
        std::vector<std::size_t> out(rows_, kNotAssigned);
        for (std::size_t column = 1; column <= columns_; ++column) {
            if (row_of_[column] <= rows_) {
                out[row_of_[column] - 1U] = column - 1U;
            }
        }
        return out;
    }

private:
    [[nodiscard]] double cost(std::size_t row, std::size_t column) const {
        return row <= rows_ && column <= columns_ ? -values_[(row - 1U) * columns_ + column - 1U] : 0.0;
    }

    /// Shortest augmenting path from `row` to a free column, by Dijkstra on reduced costs.
    void insert(std::size_t row) {
        std::vector<double> distance(n_ + 1U, std::numeric_limits<double>::infinity());
        std::vector<std::size_t> previous(n_ + 1U, 0U);
        std::vector<bool> done(n_ + 1U, false);
        row_of_[0] = row;
        std::size_t column = 0;
        while (row_of_[column] != 0U) {
            done[column] = true;
            column = nearest(column, distance, previous, done);
        }
        while (column != 0U) {
            row_of_[column] = row_of_[previous[column]];
            column = previous[column];
        }
    }

    std::size_t nearest(std::size_t from, std::vector<double>& distance, std::vector<std::size_t>& previous,
                        const std::vector<bool>& done) {
        const std::size_t row = row_of_[from];
        double step = std::numeric_limits<double>::infinity();
        std::size_t next = 0;
        for (std::size_t j = 1; j <= n_; ++j) {
            if (done[j]) {
                continue;
            }
            const double reduced = cost(row, j) - row_potential_[row] - column_potential_[j];
            if (reduced < distance[j]) {
                distance[j] = reduced;
                previous[j] = from;
            }
            if (distance[j] < step) {
                step = distance[j];
                next = j;
            }
        }
        for (std::size_t j = 0; j <= n_; ++j) {
            if (done[j]) {
                row_potential_[row_of_[j]] += step;
                column_potential_[j] -= step;
            } else {
                distance[j] -= step;
            }
        }
        return next;
    }

    const std::vector<double>& values_;
    std::size_t rows_;
    std::size_t columns_;
    std::size_t n_;
    std::vector<double> row_potential_;
    std::vector<double> column_potential_;
    std::vector<std::size_t> row_of_;  // by column; 0: free
};

}  // namespace

std::vector<std::size_t> best_assignment(const std::vector<double>& values, std::size_t rows, std::size_t columns) {
    return Hungarian(values, rows, columns).solve();
}

}  // namespace semtrack::sil
