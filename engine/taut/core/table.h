// Rows that are known by their names, in the order in which they were added. A table is a value: a copy may get rows
// of one's own.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/core/error.h"

namespace taut::core {

// `Row` needs a member `name`.
template <class Row>
class Table {
  public:
    // Puts it last. Expects a name that no other has.
    void add(Row row) {
        TAUT_EXPECTS(!row.name.empty() && find(row.name) == nullptr);
        rows_.push_back(std::move(row));
    }

    // Valid until the next is added.
    std::span<const Row> all() const { return rows_; }

    // nullptr when there is none of that name.
    const Row* find(std::string_view name) const {
        for (const Row& row : rows_)
            if (row.name == name) return &row;
        return nullptr;
    }

  private:
    std::vector<Row> rows_;
};

}  // namespace taut::core
